"""The program reads what VTK writes, in every form, as the same mesh. usage: written_by_vtk.py PROGRAM FOLDER"""
import pathlib
import subprocess
import sys

import vtk


def xml_files(name, folder):
    for mode in ("Ascii", "Binary", "Appended"):
        for compressor in ("None", "ZLib"):
            for order in ("LittleEndian", "BigEndian"):
                for raw in (0, 1) if mode == "Appended" else (0,):
                    writer = vtk.vtkXMLPolyDataWriter()
                    getattr(writer, f"SetDataModeTo{mode}")()
                    getattr(writer, f"SetCompressorTypeTo{compressor}")()
                    getattr(writer, f"SetByteOrderTo{order}")()
                    writer.SetEncodeAppendedData(not raw)
                    yield writer, folder / f"{name}-{mode}-{compressor}-{order}-{raw}.vtp"


def legacy_files(name, folder):
    for version in (42, 51):
        for kind in ("ASCII", "Binary"):
            writer = vtk.vtkPolyDataWriter()
            writer.SetFileVersion(version)
            getattr(writer, f"SetFileTypeTo{kind}")()
            yield writer, folder / f"{name}-{version}-{kind}.vtk"


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(12)
    strips = vtk.vtkStripper()
    strips.SetInputConnection(sphere.GetOutputPort())
    facts = set()
    for source, name in ((sphere, "triangles"), (strips, "strips")):
        for writer, path in [*xml_files(name, folder), *legacy_files(name, folder)]:
            writer.SetInputConnection(source.GetOutputPort())
            writer.SetFileName(str(path))
            writer.Write()
            result = subprocess.run([program, "info", path], capture_output=True, text=True, check=True)
            facts.add(result.stdout + result.stderr)
    points, faces = sphere.GetOutput().GetNumberOfPoints(), sphere.GetOutput().GetNumberOfPolys()
    assert len(facts) == 1 and f"{points} vertices, {faces} faces, 1 component" in facts.pop(), facts
    return 0


if __name__ == "__main__":
    sys.exit(main())
