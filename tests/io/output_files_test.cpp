#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "temporary_folder.h"

using namespace mspskel;
using mspskel::test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

// More than are written between two questions.
const std::string kLarge(3000000, 'x');

// One that is replaced, one in a folder of its own.
void write_two(const TemporaryFolder& folder, OutputFiles& files) {
  files.add(folder.path("a.txt"), kLarge);
  files.make_folder(folder.path("deep/er"));
  files.add(folder.path("deep/er/b.txt"), "second");
}

}  // namespace

TEST_CASE("files that are written together appear when they are committed") {
  const TemporaryFolder folder;
  folder.write("a.txt", "before");
  OutputFiles files;
  write_two(folder, files);
  CHECK(folder.read("a.txt") == "before");
  CHECK_FALSE(fs::exists(folder.path("deep/er/b.txt")));
  files.commit();
  CHECK(folder.read("a.txt") == kLarge);
  CHECK(folder.read("deep/er/b.txt") == "second");
  CHECK(folder.count() == 2);
}

TEST_CASE("files that are not committed leave nothing, and what was there stays") {
  const TemporaryFolder folder;
  folder.write("a.txt", "before");
  fs::create_directory(folder.path("deep"));
  {
    OutputFiles files;
    write_two(folder, files);
  }
  CHECK(folder.read("a.txt") == "before");
  CHECK(fs::is_empty(folder.path("deep")));
  CHECK(folder.count() == 2);
}

TEST_CASE("a pipe that nobody reads is an error, and leaves nothing of the other files") {
  const TemporaryFolder folder;
  folder.write("a.txt", "before");
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  ::close(ends[0]);
  {
    OutputFiles files;
    write_two(folder, files);
    files.add("/dev/fd/" + std::to_string(ends[1]), "to nobody");
    CHECK_THROWS_AS(files.commit(), WriteError);
  }
  ::close(ends[1]);
  CHECK(folder.read("a.txt") == "before");
  CHECK(folder.count() == 1);
}

TEST_CASE("writing asks whether to stop until the files have their names") {
  int last = 0;
  for (bool stopped = true; stopped; ++last) {
    const TemporaryFolder folder;
    folder.write("a.txt", "before");
    int asked = 0;
    stopped = false;
    try {
      OutputFiles files([&](const char*, double) { return asked++ < last; });
      write_two(folder, files);
      files.commit();
    } catch (const Cancelled&) {
      stopped = true;
    }
    CHECK(asked == (stopped ? last + 1 : last));
    CHECK(folder.read("a.txt") == (stopped ? "before" : kLarge));
    CHECK(fs::exists(folder.path("deep")) != stopped);
    CHECK(folder.count() == (stopped ? 1 : 2));
  }
  CHECK(last > 10);
}

TEST_CASE("a file of several that cannot be written takes the others away") {
  const TemporaryFolder folder;
  folder.write("a.txt", "before");
  {
    OutputFiles files;
    files.add(folder.path("a.txt"), "after");
    CHECK_THROWS_AS(files.add(folder.path("no/such/b.txt"), "x"), WriteError);
    CHECK_THROWS_AS(files.make_folder(folder.path("a.txt/c")), WriteError);
  }
  CHECK(folder.read("a.txt") == "before");
  CHECK(folder.count() == 1);
  if (!fs::exists("/dev/full")) return;
  {
    OutputFiles files;
    files.add(folder.path("a.txt"), "after");
    files.add("/dev/full", "x");
    CHECK_THROWS_WITH(files.commit(), Catch::Contains("/dev/full"));
  }
  CHECK(folder.read("a.txt") == "before");
  CHECK(folder.count() == 1);
}
