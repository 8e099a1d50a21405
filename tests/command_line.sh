#!/usr/bin/env bash
# The command line: exit codes, help with examples, and JSON that parses.
set -euo pipefail
ostium=$1

expect() { # expect CODE WORD COMMAND...: exit code and a word of the output
  local code=$1 word=$2 rc=0 out
  shift 2
  out=$("$@" 2>&1) || rc=$?
  if ((rc != code)) || ! grep -q -- "$word" <<<"$out"; then
    printf 'wanted exit %s and "%s" from: %s\ngot exit %s and:\n%s\n' "$code" "$word" "$*" "$rc" "$out"
    exit 1
  fi
}

expect 0 "Examples" "$ostium" verify --help
expect 0 "verify" "$ostium" --help
expect 0 "0\." "$ostium" --version
expect 0 "pass" "$ostium" verify --only rod-static-0.4m-100
expect 0 '"pass": true' "$ostium" verify --only rod-static --json
expect 0 "elastica" "$ostium" verify --list
expect 0 '"what"' "$ostium" verify --list --json
expect 2 "no gate begins" "$ostium" verify --only no-such-gate
expect 2 "no gate begins" "$ostium" verify --only rod-staticX
expect 1 "could not be written" bash -c "'$ostium' verify --only rod-static --json > /dev/full"
expect 2 "not expected" "$ostium" verify --quik
expect 2 "subcommand" "$ostium"

expect 0 "Examples" "$ostium" instruments --help
expect 0 "guide-jl4-6f" "$ostium" instruments
expect 0 "sources:" "$ostium" instruments guide-jl4-6f
expect 0 '"EI1_Nmm2"' "$ostium" instruments wire-014-workhorse --json
expect 3 "there is no instrument" "$ostium" instruments no-such-thing
expect 3 "cannot be written" "$ostium" instruments --picture /nowhere/all.svg
expect 3 "OSTIUM_DATA" env OSTIUM_DATA=/nowhere "$ostium" instruments
