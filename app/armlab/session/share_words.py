"""Words that come in most states, for the packer of `armlab.session.share` to refer to; a part of its version.

The most frequent ones stand last. Line breaks of this file do not count.
"""

from __future__ import annotations

FREQUENT = rb"""
"checked_axes":null,"axes_checks":0,"axes_misses":[0,0,0,0,0,0,0,0,0,0,0],"placed":true,
"checked_cells":"table_checks":1,"cell_misses":[[0,0,0,0],[0,0,0,0],[0,0,0,0]],"shown":1},
"pose_view":{"reference":"w","frame":"E","axes":"zyx","fixed":true},"ellipsoid":"rotation",
"sweep":{"joint":1,"start":},"notation":{"angle":"rad","length":"m","variable":"theta",
"book":"craig"},"lines":{"lines":[[[],[]],[[],[]]],"pair":0,"handle":"turn"},
"timeline":{"clip":"film","time":,"speed":0.5,"loop":true},"point":[0,0,0.1],
"display":{"skeleton":true,"frames":true,"names":true,"trace":true,"ellipsoid":true,
"projections":true,"angles":true,"lengths":true,"symbols":true,"turn":true,"swept":true},
"trainer":{"started":true,"before":[],"axes":[["+x","+y"],["-z","-x"],["+z","-y"],["",""]],
"cells":[[null,null,null,null],"target":{"pose":[[,0,1,0],[0,0,0,1]],"axes":"tool","handle":"turn",
"method":"dls"},"joints":{"q":[1.570796327,-1.570796327,0.785398163,3.141592654],"locked":[false,
false,true,false,false,false],"draws":1},"moved":[[0,0],[0,0]],"origin":"puma560",
"toml":"name = \"My arm\"\nfamily = \"with sliding joints\"\nfamily = \"planar\"\n
family = \"spatial 3R to 5R\"\nfamily = \"six joints\"\nfamily = \"seven joints and more\"\n
summary = \"An arm of your own.\"\nconvention = \"modified\"\nconvention = \"standard\"\n
task = \"pose\"\nsource = \"Edited on screen.\"\n\n[camera]\nazimuth_deg = -50\nelevation_deg = 22\n
distance = 1\n\n[base]\nposition = [0, 0, 0.5]\nrpy_deg = [0, 0, 90]\n\n[tool]\nposition = [0, 0,
 0.1]\nrotation = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]\n\n[[poses]]\nname = \"zero\"\nq_deg_m = [0, 0]
\nq_deg = [0, 90, -90, 0, 0, 0]\n\n[[poses]]\nname = \"home\"\n\n[[joints]]
\ntype = \"P\"\na = 0.1\nd = 0.5\ntheta_deg = 90\nlimits_m = [0, 0.5]\nspeed_m_s = 1\n\n[[joints]]
\ntype = \"R\"\na = 0.4\nalpha_deg = -90\nd = 0.3\nlimits_deg = [-180, 180]
\nspeed_deg_s = 180\nacceleration_deg_s2 = 360\n\n[[joints]]\ntype = \"R\"\nalpha_deg = 90\n
"robot":{"toml":
""".replace(b"\n", b"")
