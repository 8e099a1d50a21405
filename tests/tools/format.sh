#!/usr/bin/env bash
# Sources are formatted as .clang-format says. `tests/tools/format.sh . --fix` formats them.
set -euo pipefail
cd "$1"
command -v clang-format >/dev/null || { echo "skipped: there is no clang-format here"; exit 77; }
version=$(clang-format --version | grep -oE '[0-9]+' | head -n 1)
((version == 14)) || { echo "skipped: the layout is that of clang-format 14, here is $version"; exit 77; }
mode=(--dry-run -Werror)
[[ ${2:-} == --fix ]] && mode=(-i)
find app core vascular fluoro device data tests -name '*.h' -o -name '*.cpp' | xargs clang-format "${mode[@]}"
