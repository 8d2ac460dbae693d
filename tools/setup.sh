#!/bin/sh
# Sets up everything the project needs in .venv, and the system packages that may be installed here.
# Safe to run again: what is there is left alone.
set -eu
cd "$(dirname "$0")/.."

PYTHON=${PYTHON:-python3}

say() { echo "setup: $*"; }

# apt_install PACKAGE...: true where the packages could be installed
apt_install() {
    command -v apt-get >/dev/null || return 1
    if [ "$(id -u)" = 0 ]; then as_root=""
    elif sudo -n true 2>/dev/null; then as_root="sudo -n"
    else return 1
    fi
    $as_root env DEBIAN_FRONTEND=noninteractive sh -c \
        'apt-get update -qq && apt-get install -qq -y --no-install-recommends "$@"' sh "$@" \
        >/dev/null 2>&1
}

has_library() { "$PYTHON" -c "import ctypes; ctypes.CDLL('$1')" 2>/dev/null; }

if ! "$PYTHON" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
    say "expected Python 3.11 or newer as $PYTHON (or PYTHON=...), found $("$PYTHON" -V 2>&1 || true)"
    exit 1
fi

if [ ! -x .venv/bin/pip ]; then
    if ! "$PYTHON" -c 'import venv, ensurepip' 2>/dev/null; then
        say "installing python3-venv"
        apt_install python3-venv || { say "python3-venv is missing: install it as root"; exit 1; }
    fi
    "$PYTHON" -m venv .venv
fi

# A module is compiled when it is first imported, unless Python is told not to keep that: to compile
# all of them here takes half the processor time, and few are ever imported.
compile=--no-compile
[ -z "${PYTHONDONTWRITEBYTECODE:-}" ] || compile=--compile

say "installing the pinned packages into .venv"
PIP_CONSTRAINT=$PWD/constraints.txt .venv/bin/python -m pip install \
    --quiet --disable-pip-version-check "$compile" --editable '.[dev]'

if ! has_library libOSMesa.so.8 && ! has_library libOSMesa.so.6; then
    say "installing libosmesa6, the software renderer"
    apt_install libosmesa6 ||
        say "libosmesa6 is missing and cannot be installed here: rendering falls back to EGL, then Embree"
fi
say "done"
