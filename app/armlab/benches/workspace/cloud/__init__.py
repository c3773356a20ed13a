"""The page Reachable of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "workspace",
    "Workspace",
    "CHART_DOTS_3",
    36,
    page="Reachable",
    about=(
        "S4.2-ws1",
        "4.2",
        "(4.17-4.19)",
        "workspace",
        "reachable workspace",
        "primary workspace",
        "reach",
        "coloured by manipulability",
        "point cloud",
        "reachability",
        "voxels",
    ),
    exports=(
        Export("csv", "Points of the workspace as CSV", ("cloud", "table"), "the workspace has been sampled"),
        Export("ply", "Points of the workspace as PLY", ("cloud", "3D"), "the workspace has been sampled"),
        Export(
            "png", "Picture of the scene as PNG", ("screenshot", "image", "photo"), "the workspace has been sampled"
        ),
    ),
)
