"""Shows the blocks of a run in ParaView 5.9 or later in the colour of their velocity along x: true shapes, or oriented boxes.

In the program:  MUSIM_RESULTS=out/tower paraview --script=/usr/share/musim/paraview_blocks.py
As a picture:    pvpython /usr/share/musim/paraview_blocks.py out/tower picture.png [TIME]   (without a display: xvfb-run -s -noreset pvpython ...)
By hand: open result.xdmf with the "XDMF Reader" (not Xdmf3). Blocks of any shape are surfaces, shown as they are. Where all are boxes they are
points: representation "3D Glyphs", glyph type Box, orientation mode Quaternion by "quaternion", scale mode Vector Components by "size [m]",
scale factor 1.
"""
import os
import sys

from paraview import simple

results = sys.argv[1] if len(sys.argv) > 1 else os.environ.get("MUSIM_RESULTS")
if not results or not os.path.exists(os.path.join(results, "result.xdmf")):
    sys.exit(f"{results}: there is no result.xdmf here; give the directory of `musim run -o`, as an argument or in MUSIM_RESULTS")

reader = simple.XDMFReader(FileNames=[os.path.abspath(os.path.join(results, "result.xdmf"))])
reader.UpdatePipelineInformation()
times = list(reader.TimestepValues)
view = simple.GetActiveViewOrCreate("RenderView")
view.ViewTime = float(sys.argv[3]) if len(sys.argv) > 3 else times[len(times) // 2]
reader.UpdatePipeline(view.ViewTime)

blocks = simple.Show(reader, view)
are_shapes = reader.CellData.GetArray("block") is not None
if are_shapes:
    blocks.SetRepresentationType("Surface With Edges")
else:
    blocks.SetRepresentationType("3D Glyphs")
    blocks.GlyphType = "Box"
    blocks.Orient = 1
    blocks.OrientationMode = "Quaternion"
    blocks.SelectOrientationVectors = "quaternion"
    blocks.Scaling = 1
    blocks.ScaleMode = "Vector Components"
    blocks.SelectScaleArray = "size [m]"
    blocks.ScaleFactor = 1.0
data = reader.CellData if are_shapes else reader.PointData
if data.GetArray("velocity [m/s]") is not None:
    simple.ColorBy(blocks, ("CELLS" if are_shapes else "POINTS", "velocity [m/s]", "X"))
    low, high = data["velocity [m/s]"].GetRange(0)
    limit = max(abs(low), abs(high)) or 1.0
    simple.GetColorTransferFunction("velocity [m/s]").RescaleTransferFunction(-limit, limit)
    blocks.SetScalarBarVisibility(view, True)

low_x, high_x, low_y, high_y, low_z, high_z = reader.GetDataInformation().GetBounds()
middle = [0.5 * (low_x + high_x), 0.5 * (low_y + high_y), 0.5 * (low_z + high_z)]
distance = 2.5 * max(high_x - low_x, high_z - low_z)
view.CameraFocalPoint = middle
view.CameraPosition = [middle[0], middle[1] - distance, middle[2]]
view.CameraViewUp = [0.0, 0.0, 1.0]
simple.Render(view)
if len(sys.argv) > 2:
    simple.SaveScreenshot(sys.argv[2], view, ImageResolution=[800, 1000])
