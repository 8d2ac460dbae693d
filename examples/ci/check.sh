#!/bin/sh
# check.sh [DIR]: runs this project as it is, which must be green, and with its axis ratio upside down, which must be red
# and name the gates. Pages and JUnit files go to DIR/green and DIR/red. PYTEST names a pytest beside rockshape.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
pytest=${PYTEST:-pytest}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/report"
report=${1:-$work/report}
mkdir -p "$report"
report=$(cd "$report" && pwd)

# run COLOUR STATUS: the project in $work/COLOUR, which must end with that status
run() {
    cd "$work/$1"
    status=0
    "$pytest" --rockshape-suite my.toml --rockshape-report "$report/$1" --junitxml "$report/$1/junit.xml" \
        >"$work/$1.txt" 2>&1 || status=$?
    cat "$work/$1.txt"
    [ "$status" = "$2" ] || { echo "expected exit status $2 of the $1 run, found $status"; exit 1; }
}

cp -r "$here" "$work/green"
cp -r "$here" "$work/red"
sed -i 's|region.axis_minor_length / region.axis_major_length|region.axis_major_length / region.axis_minor_length|' \
    "$work/red/my_measures.py"
run green 0
run red 1
for gate in 'drawn.mine.sphericity.axis_ratio.tau>=0.9' 'rocks.mine.axis_ratio.view_error<=0.03'; do
    grep -qF "FAILED my.toml::$gate" "$work/red.txt" || { echo "expected the failed gate $gate, found none"; exit 1; }
done
echo "green and red as they must be"
