# Sourced by experiments/quickstart.sh, experiments/docs.sh and tests/run.sh: what a fresh Debian 12 needs, and how ssrlab is built.

# What building and running needs.
build_packages=(
    g++ cmake ninja-build ccache pkg-config git ca-certificates
    libvulkan-dev mesa-vulkan-drivers glslang-dev spirv-tools
    libembree-dev libtbb-dev libopenexr-dev libpng-dev libjpeg-dev libglm-dev libtinygltf-dev
    libwebp-dev libmeshoptimizer-dev libdraco-dev  # textures and geometry of glTF files that are compressed by them
    liblcms2-dev  # colour profiles of PNG files
    libboost-dev  # Sobol's sequence, for designs of studies; distribution functions
    libre2-dev  # regular expressions of scene files, in linear time
    libcpp-httplib-dev  # the page of `ssrlab watch`
    libvalijson-dev  # JSON Schema: glTF files are checked by one
    esbuild  # bundles the scripts of pages
    nlohmann-json3-dev libcli11-dev libkainjow-mustache-dev libxxhash-dev zlib1g-dev libbenchmark-dev libgtest-dev
    python3 python3-numpy python3-matplotlib python3-pil
    python3-scipy  # distributions of `ssrlab tables` and `ssrlab tune`, and the fit of the latter's optimiser
)
# What only the tests need: the validation layer, a browser for the report, Snakemake for studies in parallel, pandas for the example that
# reads results, Node.js for the adapters of engines, and readers of Markdown and LaTeX (40 MB to fetch), which say what names in tables do there.
test_packages=(vulkan-validationlayers clang-format chromium chromium-driver nodejs python3-selenium snakemake python3-pandas python3-jsonschema
               python3-markdown-it texlive-latex-base)
# What only tests/exporters.sh needs: Blender; RenderDoc, its Python module, and the header of its in-application API.
exporter_packages=(blender librenderdoc librenderdoc-dev python3-renderdoc)
# What only tests/experiments/cluster/slurm_test.sh needs: Slurm's daemons and commands, and what they know each other by.
cluster_packages=(snakemake slurmctld slurmd slurm-client munge)
# What only experiments/engines needs: Node.js serves pages with engines from its registry, and a browser runs them; programs
# that draw on a display get Xvfb. Its run.sh adds the engines that are Debian's.
engine_packages=(nodejs chromium xvfb xauth libgl1-mesa-dri)
# What only the website of the documents needs.
docs_packages=(python3-sphinx python3-myst-parser furo)

say() { printf '\n== %s\n' "$*"; }
die() { printf 'error: %s\n' "$*" >&2; exit 3; }

# install_packages NAME...: installs with apt what dpkg does not know as installed; says so and does nothing if all is there.
install_packages() {
    local missing=() package root=()
    for package in "$@"; do
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then say "All $# packages are installed"; return; fi
    command -v apt-get >/dev/null || die "apt-get is not here: install these packages by hand (Debian names): ${missing[*]}"
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "these packages are missing and neither root nor sudo is at hand: ${missing[*]}"
        root=(sudo)
    fi
    say "Installing ${#missing[@]} packages: ${missing[*]}"
    "${root[@]}" apt-get update -qq || true  # a stale list may do; if not, the next line says what is wrong
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
        die "apt could not install ${missing[*]}: is there a network connection, and a Debian 12 mirror in /etc/apt/sources.list?"
}

# build PRESET [TARGET...]: configures and builds into build/PRESET; all targets if none is named.
build() {
    local preset=$1 targets=()
    shift
    [ $# -eq 0 ] || targets=(--target "$@")
    say "Building ($preset)"
    cmake --preset "$preset" >/dev/null || die "cmake could not configure the preset '$preset'; its messages are above"
    cmake --build --preset "$preset" "${targets[@]}" -- --quiet || die "the build failed; the compiler's messages are above"
}
