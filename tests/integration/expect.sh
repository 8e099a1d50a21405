# Sourced by tests of the command line.
trap 'echo "line $LINENO: $BASH_COMMAND"' ERR

expect() { # expect CODE WORD COMMAND...: exit code and a word of the output
  local code=$1 word=$2 rc=0 out
  shift 2
  out=$("$@" 2>&1) || rc=$?
  if ((rc != code)) || ! grep -q -- "$word" <<<"$out"; then
    printf 'wanted exit %s and "%s" from: %s\ngot exit %s and:\n%s\n' "$code" "$word" "$*" "$rc" "$out"
    exit 1
  fi
}
