#!/usr/bin/env bash
# Builds the wheel and uses it outside the checkout, in a fresh environment for each of
#   oldest   the lower bounds that pyproject.toml declares, with a part of the tests
#   newest   whatever the index offers today
#   3.13     the same on Python 3.13, where this machine has one
# Usage: tools/check_wheel.sh [oldest|newest|3.13]...
set -euo pipefail
unset PYTHONDONTWRITEBYTECODE # pip leaves modules uncompiled below, so the first import keeps them
cd "$(dirname "$0")/.."

CHECKOUT=$PWD
PYTHON=${PYTHON:-$CHECKOUT/.venv/bin/python}
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
IMAGE=$CHECKOUT/examples/mars/i944014r.png
RANGE=$CHECKOUT/examples/mars/i944014r_xyz.npz
SMOKE_TESTS="tests/rockshape/measures tests/rockshape/ground tests/rockshape/segmentation/test_real_frame.py
    tests/rockshape/test_pipeline.py tests/synth/test_render.py"

say() { echo "wheel: $*"; }

quiet() { # COMMAND...: its output only where it fails
    "$@" >"$WORK/log" 2>&1 || { cat "$WORK/log"; say "failed: $*"; return 1; }
}

# Every dependency is written as NAME>=VERSION with a version that exists, held to by a test.
oldest_constraints() { sed -n '/^dependencies = \[/,/^\]/s/^ *"\([^">]*\)>=\([^";]*\)".*/\1==\2/p' pyproject.toml; }

python313() { # the first Python 3.13 that runs
    local candidate
    for candidate in python3.13 "${PYENV_ROOT:-$HOME/.pyenv}"/versions/3.13.*/bin/python; do
        if "$candidate" -c 'import sys, ensurepip; sys.exit(sys.version_info[:2] != (3, 13))' 2>/dev/null; then
            echo "$candidate"
            return 0
        fi
    done
    return 1
}

install() { # NAME PYTHON [PIP ARGUMENTS...]
    local name=$1 python=$2
    shift 2
    quiet "$python" -m venv "$WORK/$name"
    quiet "$WORK/$name/bin/python" -m pip install --no-compile --disable-pip-version-check "$@" \
        "$WORK"/dist/rockshape-*.whl pytest hypothesis
    quiet "$WORK/$name/bin/python" -m pip check
}

same_rocks() { # NAME COUNT: as many rocks in the example as with every other environment
    say "$1: $2 rocks measured"
    [ -f "$WORK/rocks" ] || echo "$2" >"$WORK/rocks"
    [ "$2" -gt 0 ] && [ "$2" = "$(cat "$WORK/rocks")" ] ||
        { say "$1: expected $(cat "$WORK/rocks") rocks as before, found $2"; return 1; }
}

use() { # NAME: what a user does first, far from the checkout
    local bin=$WORK/$1/bin
    mkdir "$WORK/$1-use"
    cd "$WORK/$1-use"
    say "$1: $("$bin/rockshape" --version) from $("$bin/python" -c \
        'import rockshape, pathlib; print(pathlib.Path(rockshape.__file__).parent.relative_to(pathlib.Path.cwd().parent))')"
    quiet "$bin/rockshape" measure "$IMAGE" --range "$RANGE" --out rocks.csv --overlay rocks.png
    same_rocks "$1" $(($(wc -l <rocks.csv) - 1))
    quiet "$bin/rockshape" synth scene scenes --site plain --rocks 2 --views 1 --seed 1
    "$bin/rockshape" validate run --suite shapes-roundness --out suite --jobs 1 2>"$WORK/log" ||
        { cat "$WORK/log"; return 1; }
    quiet "$bin/python" -m pytest -p no:cacheprovider --rockshape-suite shapes-roundness --rockshape-jobs 1
    say "$1: as pytest items: $(tail -1 "$WORK/log")"
    cd "$CHECKOUT"
}

readme_lines() { # NAME: the Python that README.md shows
    cd "$WORK/$1-use"
    cp -r "$CHECKOUT/examples" .
    "$PYTHON" "$CHECKOUT/tools/doc_blocks.py" "$CHECKOUT/README.md" >readme.py
    quiet env MPLBACKEND=Agg "$WORK/$1/bin/python" readme.py
    say "$1: the Python of README.md runs"
    cd "$CHECKOUT"
}

smoke_tests() { # NAME: part of the tests on the installed wheel, without the checkout's packages
    mkdir "$WORK/$1-tests"
    cp -r tests examples "$WORK/$1-tests"
    cd "$WORK/$1-tests"
    # shellcheck disable=SC2086 # several paths
    "$WORK/$1/bin/python" -m pytest -q -p no:cacheprovider --import-mode=importlib $SMOKE_TESTS 2>&1 | tail -3
    cd "$CHECKOUT"
}

quiet "$PYTHON" -m pip wheel --no-deps --wheel-dir "$WORK/dist" .
say "built $(basename "$WORK"/dist/rockshape-*.whl)"
for flavour in "${@:-oldest newest 3.13}"; do
    for name in $flavour; do
        SECONDS=0
        case $name in
        oldest)
            oldest_constraints >"$WORK/oldest.txt"
            install oldest "$PYTHON" --constraint "$WORK/oldest.txt"
            use oldest
            smoke_tests oldest
            ;;
        newest)
            install newest "$PYTHON"
            use newest
            readme_lines newest
            ;;
        3.13)
            if ! python=$(python313); then
                say "3.13: not checked, this machine has no Python 3.13"
                continue
            fi
            install py313 "$python"
            use py313
            ;;
        *)
            say "expected oldest, newest or 3.13, found $name"
            exit 2
            ;;
        esac
        say "$name: done in $SECONDS s"
    done
done
