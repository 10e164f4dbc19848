#!/usr/bin/env bash
# Unpacks a newer Mesa's driver into a folder, for chips that the installed Mesa does not know. Nothing is installed: apt
# gets settings, lists and a cache of its own, and no rights of root are needed.
set -euo pipefail

# Of Debian's bookworm-backports; the driver asks for libdrm 2.4.121 or newer. Its libllvm15 is Debian 12's own, which comes
# with mesa-vulkan-drivers.
packages=(mesa-vulkan-drivers=25.0.7-2~bpo12+1 libdrm2=2.4.123-1~bpo12+1 libdrm-amdgpu1=2.4.123-1~bpo12+1)
mirror=http://deb.debian.org/debian
keys=/usr/share/keyrings/debian-archive-keyring.gpg

case "${1:-}" in
-h | --help)
    echo "usage: experiments/newer_mesa.sh FOLDER"
    echo "Downloads the driver of Mesa 25.0.7 (13 MB) and unpacks it into FOLDER, which must be empty or new. Nothing is"
    echo "installed. 'ssrlab shaders --mesa FOLDER' and studies with SSRLAB_MESA=FOLDER then compile for RDNA 3.5 and 4."
    exit
    ;;
esac

die() { printf 'error: %s\n' "$*" >&2; exit "$code"; }
code=2
[ $# -eq 1 ] && [[ $1 != -* ]] || die "name one folder: experiments/newer_mesa.sh FOLDER"
folder=$1
[ ! -e "$folder" ] || [ -d "$folder" ] || die "'$folder' is no folder; name a new one"
[ -z "$(ls -A -- "$folder" 2>/dev/null)" ] || die "'$folder' is not empty; name a new folder"
code=3
for program in apt-get dpkg; do
    command -v $program >/dev/null || die "$program is not here: this script needs Debian 12, or a system with its packages"
done
[ -e "$keys" ] || die "$keys is not here, which says whose packages are Debian's (apt-get install debian-archive-keyring)"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{lists,cache,debs}
echo "deb [signed-by=$keys] $mirror bookworm-backports main" >"$work/sources.list"
# The system's settings are read first, since they may name a proxy. Its actions after an update are not for these lists.
cat >"$work/apt.conf" <<END
#clear APT::Update::Pre-Invoke;
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
Dir::Etc::sourcelist "$work/sources.list";
Dir::Etc::sourceparts "/dev/null";
Dir::State::lists "$work/lists";
Dir::Cache "$work/cache";
APT::Sandbox::User "$(id -un)";
END
apt=(apt-get -qq -c "$work/apt.conf")
"${apt[@]}" update || die "the list of bookworm-backports cannot be read: is there a connection to $mirror?"
(cd "$work/debs" && "${apt[@]}" download "${packages[@]}") ||
    die "apt cannot download ${packages[*]}; if bookworm-backports has other versions today, name these in the script"
mkdir -p "$folder"
for package in "$work"/debs/*.deb; do dpkg -x "$package" "$folder"; done
echo "Unpacked ${packages[*]} into $folder. To compile for its chips:"
printf '  export SSRLAB_MESA=%q\n' "$(realpath "$folder")"
