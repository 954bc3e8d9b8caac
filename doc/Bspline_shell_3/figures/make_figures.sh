#!/usr/bin/env bash
# Generates the figures of the manual in doc/Bspline_shell_3/fig (Debian 12):
#   bash doc/Bspline_shell_3/figures/make_figures.sh
# Installs missing packages, builds the programs of the gallery, runs them on meshes of the Debian package libcgal-demo,
# and draws their output.
set -euo pipefail
cd "$(dirname "$0")/../../.."
. cmake/install_packages.sh
install_packages "${BUILD_PACKAGES[@]}" python3 python3-matplotlib python3-pil python3-vtk9 xvfb xauth libtet1.5-dev chromium xdotool imagemagick

here=doc/Bspline_shell_3/figures build=$PWD/build/gallery data=build/figures fig=doc/Bspline_shell_3/fig
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S examples/Bspline_shell_3/gallery -B "$build" -DCMAKE_BUILD_TYPE=Release -G Ninja -Wno-dev "${launcher[@]}"
cmake --build "$build"

rm -rf "$data"
mkdir -p "$data"
run() { echo "figure_data $*"; "$build/figure_data" "$1" "$build/data/meshes/$2.off" "$data/$2" "${@:3}"; }
run curves eight 0.1 150
run rounds homer 0.02
run remesh joint 0.01 20
run open lion 0.01 0
run open three_peaks 0.01 0
run texture elephant 0.02 800
"$build/figure_data" truncate examples/Bspline_shell_3/four_cubes.off "$data/four_cubes" 0.01 30
"$build/figure_data" soup "$data/figure"
"$build/figure_data" excised "$data/ball"
tool() { echo "bspline_shell $*"; "$build/bspline_shell" "$@"; }
elephant=$build/data/meshes/elephant.off
tool shell "$elephant" -o "$data/thick" --thickness 4%
tool simplify "$elephant" -o "$data/colored_simplified.ply" --shell "$data/colored"
tool simplify "$elephant" -o "$data/viewed.ply" --facets 800 --view "$data/page.html"
/usr/bin/python3 examples/Bspline_shell_3/paint_meshes.py "$data/colored"
tool transfer "$data"/colored_{painted,subdivided}.ply -o "$data/colored_detail.ply"
(cd "$data" && "$build/heat_geodesics" "$build/data/meshes/rotor.off" 100 1)
(cd "$data" && "$build/boolean_colors" "$build/data/meshes/bear.off")
mkdir "$data"/fields_{1,4}
(cd "$data/fields_1" && "$build/transfer_direction_field" "$build/data/meshes/elephant.off" 1 1200)
(cd "$data/fields_4" && "$build/transfer_direction_field" "$build/data/meshes/bunny00.off" 4 2000)
echo "resolution_benchmark armadillo.off"
"$build/resolution_benchmark" --gamma 30,50,90,130 --output "$data/armadillo" 2 0.5 "$build/data/meshes/armadillo.off" >"$data/armadillo.jsonl"
python3 benchmark/Bspline_shell_3/Robustness/thin_models.py "$data/thin"
"$build/figure_data" sides "$data/thin/bowl_2.off" "$data/bowl" 0.1
mkdir "$data/bent"
cp "$build/data/meshes/anchor.off" "$data/bent"
echo "elastic_proxy anchor.off 25"
(cd "$data/bent" && "$build/elastic_proxy" anchor.off 25)

export PYTHONPATH=examples/Bspline_shell_3 PYTHONDONTWRITEBYTECODE=1        # the folder of render_shell.py
/usr/bin/python3 "$here/draw_claims.py" "$fig/claims.png"
/usr/bin/python3 "$here/draw_slices.py" "$data/homer" "$fig"
xvfb-run -a /usr/bin/python3 "$here/draw_meshes.py" "$data" "$fig"
xvfb-run -a /usr/bin/python3 examples/Bspline_shell_3/render_shell.py "$data/thick" "$fig/elephant_shell.png"
xvfb-run -a /usr/bin/python3 examples/Bspline_shell_3/render_shell.py "$data/colored" "$fig/elephant_simplified.png"
xvfb-run -a /usr/bin/python3 "$here/draw_studies.py" "$data/armadillo" "$fig/resolutions.png"

# CGAL's Polyhedron demo with the plugin
bash examples/polyhedron_demo.sh --build
xvfb-run -a -s "-screen 0 1300x760x24" bash "$here/draw_demo.sh" build/polyhedron_demo/demo/Polyhedron_3 "$elephant" "$fig/polyhedron_demo.png"

# the page of a data set, which includes a truncated file
printf "$build/data/meshes/%s.off\n" anchor bear bull cow eight elephant fandisk homer joint lion-head rotor three_peaks triceratops >"$data/data_set.txt"
head -c 1000 "$build/data/meshes/cow.off" >"$data/cut_off.off"
echo cut_off.off >>"$data/data_set.txt"
bash examples/data_set.sh "$data/data_set.txt" results="$data/data_set" time_limit=120 batch=3
chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=1300,1560 \
         --screenshot="$fig/data_set.png" "file://$PWD/$data/data_set/index.html"
/usr/bin/python3 "$here/draw_page.py" "$data/page.html" "$fig/page.png"
