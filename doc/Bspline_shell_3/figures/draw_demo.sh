#!/usr/bin/env bash
# Draws the window of the Polyhedron demo, with a mesh, its shell, and the menu of the plugin:
#   xvfb-run -a -s "-screen 0 1300x760x24" bash draw_demo.sh DEMO MESH PICTURE
set -euo pipefail
demo=$(realpath "$1") mesh=$(realpath "$2") picture=$(realpath -m "$3") home=$(mktemp -d)
export HOME=$home XDG_CONFIG_HOME=$home
cd "$home"      # The demo stores its settings there.
cat >view.js <<END
main_window.open("$mesh", "off_plugin")
bspline_shell_plugin.build_shell(0, 3, 60)
bspline_shell_plugin.simplify(0, 600, 60)
END
"$demo" view.js >demo.log 2>&1 &
trap 'kill $!; rm -rf "$home"' EXIT
sleep 10        # until the demo has run the script and drawn its result
window=$(xdotool search --onlyvisible --name "CGAL Polyhedron Demo")
xdotool windowsize "$window" 1300 760 windowfocus "$window"
sleep 1
xdotool mousemove 121 11 click 1        # Operations
sleep 1
xdotool mousemove 175 59 click 1        # Cubic B-Spline Shell
sleep 1
import -window root +dither -colors 128 "$picture"
