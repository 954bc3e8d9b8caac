# To be sourced: installs the named Debian packages that are missing, with apt, quietly.
install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}
BUILD_PACKAGES=(g++ cmake ninja-build ccache libcgal-dev libcgal-demo libeigen3-dev libboost-dev libtbb-dev
                libgmp-dev libmpfr-dev libcli11-dev libtinygltf-dev libstb-dev libjs-three help2man)
