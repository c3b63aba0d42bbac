#!/usr/bin/env python3
"""Draws docs/figures/tutorial-setup.svg: a side view and a top view of the photo set-up."""

import math
from pathlib import Path

from drawing import BLUE, GREEN, GREY, INK, LIGHT, RED, Drawing

d = Drawing(860, 330)

# Side view: sweep of paper, table, turntable, object, camera.
d.text((215, 22), "from the side", weight="bold")
d.polygon([(40, 60), (46, 60), (46, 210), (58, 236), (90, 246), (300, 246), (300, 252), (88, 252), (52, 242), (40, 212)], "#e4e0d6")
d.text((92, 74), "backdrop: plain paper,\nbent, not white if the\nobject is white", GREY, "start", 11)
d.polygon([(118, 236), (222, 236), (222, 246), (118, 246)], "#9aa7b2")
d.polygon([(148, 236), (140, 170), (150, 138), (190, 138), (200, 170), (192, 236)], "#d8b25a", GREY)
d.line((170, 118), (170, 262), GREY, 1, "5 3")
d.text((170, 278), "axis", GREY, size=11)
d.text((238, 243), "turntable", GREY, "start", 11)
camera = (392, 118)
d.line(camera, (172, 190), LIGHT, 1.4)
d.line((392, 190), (172, 190), LIGHT, 1.2, "4 3")
d.text((300, 184), "10 to 20 degrees", INK, size=12)
d.camera(camera, (172, 190), BLUE)
d.line((392, 126), (381, 284), INK, 1.4)
d.line((392, 126), (404, 284), INK, 1.4)
d.text((392, 84), "camera on a tripod;\nfocus and exposure locked", BLUE, "middle", 11)
d.text((250, 314), "distance: 4 to 6 times the object's height; the object fills 2/3 of the image", GREY, size=11)

# Top view: lamps.
d.text((650, 22), "from above", weight="bold")
d.line((540, 54), (760, 54), "#b9b3a3", 7)
d.text((650, 78), "backdrop, a metre behind", GREY, size=11)
d.circle((650, 150), 36, "#d5dbe0", GREY)
d.circle((650, 150), 22, "#d8b25a", GREY)
for i in range(12):
    a = 2 * math.pi * i / 12
    d.line((650 + 36 * math.cos(a), 150 + 36 * math.sin(a)), (650 + 41 * math.cos(a), 150 + 41 * math.sin(a)), GREY, 1)
d.text((700, 128), "36 to 72 equal steps", INK, "start", 11)
d.line((690, 160), (688, 172), INK, 1.3, arrow=True)
for x in (545, 755):
    side = -1 if x < 650 else 1
    d.polygon([(x - 26, 236 + side * 14 - 4), (x + 26, 236 - side * 14 - 4), (x + 26, 236 - side * 14 + 4), (x - 26, 236 + side * 14 + 4)], "#ffe28a", GREY)
    d.line((x - side * 12, 222), (650 + side * 40, 172), "#e8c24a", 1.2, "4 3")
    d.text((x, 266), "lamp behind\na diffuser", GREY, size=11)
d.camera((650, 284), (650, 150), BLUE)
d.text((650, 310), "camera", BLUE, size=12)
d.write("tutorial-setup.svg", Path(__file__).parent)
