"""docs/recipes.md's C++ program builds and runs in each of the ways that its CMake examples show.

usage: recipes_test.py SOURCE_DIR BINARY_DIR WORK_DIR CXX_COMPILER GENERATOR BUILD_TYPE
"""
import pathlib
import re
import shutil
import subprocess
import sys


def run(*words):
    result = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\n{result.stdout}")
    return result.stdout


def main():
    source, binary, work = (pathlib.Path(word) for word in sys.argv[1:4])
    compiler, generator, build_type = sys.argv[4:7]
    text = (source / "docs" / "recipes.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"^```cpp\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    package, subdirectory, fetched = re.findall(r"^```cmake\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    shutil.rmtree(work, ignore_errors=True)
    run("cmake", "--install", binary, "--prefix", work / "prefix")
    for made in ["man/man1/mspskel.1", "bash-completion/completions/mspskel", "zsh/site-functions/_mspskel",
                 "fish/vendor_completions.d/mspskel.fish"]:
        if "--smallest" not in (work / "prefix" / "share" / made).read_text(encoding="utf-8").replace("\\-", "-").replace(" -l ", " --"):
            sys.exit(f"share/{made} does not know --smallest")

    def configure(name, cmake, *options):
        project = work / name
        project.mkdir(parents=True)
        (project / "main.cpp").write_text(program, encoding="utf-8")
        (project / "CMakeLists.txt").write_text(cmake, encoding="utf-8")
        if "extern/mspskel" in cmake:
            (project / "extern").mkdir()
            (project / "extern" / "mspskel").symlink_to(source, target_is_directory=True)
        run("cmake", "-S", project, "-B", project / "build", "-G", generator, f"-DCMAKE_CXX_COMPILER={compiler}", *options)
        return project / "build"

    def build_and_run(folder):
        run("cmake", "--build", folder, "--target", "my_app")
        if "degrees" not in run(folder / "my_app"):
            sys.exit(f"{folder / 'my_app'} says nothing")

    build_and_run(configure("package", package, f"-DCMAKE_PREFIX_PATH={work / 'prefix'}", f"-DCMAKE_BUILD_TYPE={build_type}"))
    # Without optimisation the header-only stages compile sooner.
    build_and_run(configure("subdirectory", subdirectory, "-DCMAKE_BUILD_TYPE=Debug"))
    # The same targets, so that nothing more is to be built.
    configure("fetched", fetched, f"-DFETCHCONTENT_SOURCE_DIR_MSPSKEL={source}")


if __name__ == "__main__":
    main()
