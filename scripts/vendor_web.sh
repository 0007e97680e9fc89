#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
# Makes the libraries that the console's page uses into one file, which is committed: the page asks no other machine
# for anything, and building the workspace needs no Node.js. Run again to take newer versions; needs npm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

three=0.187.0       # draws (MIT)
urdf_loader=0.13.1  # the robot's description as a tree of joints (Apache-2.0)
esbuild=0.28.2      # puts both into one module (MIT; not part of it)
root="$PWD"
target="$root/src/teo_console/web/vendor"

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --no-audit --no-fund --silent "three@$three" "urdf-loader@$urdf_loader" "esbuild@$esbuild"
# Only what robot_view.js uses: esbuild leaves out the rest.
cat >entry.js <<'END'
export {
    DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, SphereGeometry, Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
export { default as URDFLoader } from "urdf-loader";
END
mkdir -p "$target"
npx esbuild entry.js --bundle --minify --format=esm --target=es2022 --legal-comments=inline --outfile="$target/robot_drawing.js"
cp node_modules/three/LICENSE "$target/LICENSE.three.txt"
{ # Its package names the licence and leaves out the text.
    echo "urdf-loader $urdf_loader, Copyright 2020 California Institute of Technology, https://github.com/gkjohnson/urdf-loaders"
    echo
    cat "$root/LICENSE"
} >"$target/LICENSE.urdf-loader.txt"
cd "$target"
{
    echo "# Made by scripts/vendor_web.sh: three $three, urdf-loader $urdf_loader, esbuild $esbuild."
    sha256sum robot_drawing.js LICENSE.*
} >SHA256SUMS
