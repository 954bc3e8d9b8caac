"""Draws the page of `bspline_shell simplify --view` with the cursor on the mesh, in headless Chromium.

   draw_page.py PAGE.html IMAGE.png
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../test/Bspline_shell_3/Tool"))
sys.dont_write_bytecode = True
from browser import Browser

page, image = sys.argv[1:]
with Browser(1200, 640) as browser:
    browser.open(os.path.abspath(page))
    left, top, width, height = browser.run(
        "(r => [r.left, r.top, r.width, r.height])(document.getElementById('stage').getBoundingClientRect())")
    browser.click(left + 0.28 * width, top + 0.58 * height)       # on an ear
    browser.screenshot(image)
