#!/bin/bash
# full_disk.sh OSTIUM: on a file system that fills up the recording ends early, is said to, and what is there is whole.
# Skipped (exit code 77) where none can be mounted.
set -euo pipefail
ostium=$(realpath "$1")
if [ "${2:-}" != inside ]; then
  unshare --mount true 2>/dev/null && exec unshare --mount "$0" "$ostium" inside
  unshare --user --map-root-user --mount true 2>/dev/null && exec unshare --user --map-root-user --mount "$0" "$ostium" inside
  echo "no file system can be mounted here"
  exit 77
fi
folder=$(mktemp -d)
trap 'umount "$folder" 2>/dev/null || true; rmdir "$folder"' EXIT
for size in 300k 500k; do
  mount -t tmpfs -o size=$size tmpfs "$folder" || exit 77
  said=$("$ostium" run rca-mid-focal --script aorta-arch-wire --seconds 5 --out "$folder/out" 2>&1) && { echo "exit code 0 on a full disk"; exit 1; }
  grep -q "is the disk full?" <<<"$said" && grep -q "recorded in part in" <<<"$said" || { echo "not said: $said"; exit 1; }
  whole=$("$ostium" replay "$folder/out/run.h5" --verify 2>&1) || { echo "$whole"; exit 1; }
  grep -q "all bit for bit as recorded" <<<"$whole"
  umount "$folder"
done
echo "what is there is whole"
