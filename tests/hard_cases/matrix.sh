#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The hard cases by g++ and clang++ with the flags that hosts compile the closures with:
#
#   O0, O2, O3-native   levels of optimisation, the last for the vectors of this processor
#   sanitize            address and undefined-behaviour sanitizers
#   traps               invalid operations and divisions by zero stop the program
#   fast-math           -ffast-math in what includes the closures. What needs an infinity or a NaN
#                       is not promised there (docs/support.md) and is skipped
#
# matrix.sh --list                       the names of all configurations
# matrix.sh SOURCE BUILD [NAME ...]      each in a folder BUILD/NAME, or only those named
#
# A line for each, and as the last line how many passed and failed; a failed one does not keep the
# next from being tried. Exit code 1 if any failed.

set -euo pipefail

names=()
for compiler in g++ clang++; do
    for flags in O0 O2 O3-native sanitize traps fast-math; do names+=("$compiler-$flags"); done
done
if [[ ${1-} == --list ]]; then
    printf '%s\n' "${names[@]}"
    exit 0
fi

source=$1 build=$2
shift 2
[[ $# -eq 0 ]] || names=("$@")

# What CMake is told of a configuration: optimisation, flags of the tests alone, traps.
settings() {
    local optimise=-O2 own='' traps=OFF
    case $1 in
        *-O0) optimise=-O0 ;;
        *-O2) ;;
        *-O3-native) optimise='-O3 -march=native' ;;
        *-sanitize)
            optimise='-O1 -g1 -fno-omit-frame-pointer'
            own='-fsanitize=address,undefined -fno-sanitize-recover=undefined'
            ;;
        *-traps) traps=ON ;;
        *-fast-math) own=-ffast-math ;;
    esac
    printf '%s\n' "-DCMAKE_CXX_COMPILER=${1%%-*}" -DCMAKE_BUILD_TYPE=Release \
        "-DCMAKE_CXX_FLAGS_RELEASE=$optimise" "-DREGAIN_HARD_CASES_FLAGS=$own" \
        "-DREGAIN_HARD_CASES_TRAPS=$traps" -DREGAIN_HARD_CASES_SANITIZED=OFF \
        -DREGAIN_BUILD_TESTS=ON -DREGAIN_BUILD_TOOLS=OFF -DREGAIN_BUILD_SHADERS=OFF \
        -DREGAIN_BUILD_ADAPTERS=OFF
}

# Says why NAME failed, and shows the last of what was written about it.
failure() {
    echo "$1: FAILED, $2; all of it is in $3"
    grep -E 'error|Failure|FAILED|runtime error|ERROR' "$3" | head -n 20 >&2 || true
}

# Configures, builds and runs one configuration, and says how it went.
try() {
    local folder=$build/$1 log=$build/$1.log options=() tests skipped code=0
    mapfile -t options < <(settings "$1")
    : >"$log"
    if ! cmake -S "$source" -B "$folder" -G Ninja "${options[@]}" >>"$log" 2>&1 </dev/null; then
        failure "$1" 'it cannot be configured' "$log"
        return 1
    fi
    if ! cmake --build "$folder" --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-1}" \
        --target hard_cases_test >>"$log" 2>&1 </dev/null; then
        failure "$1" 'it does not build' "$log"
        return 1
    fi
    "$folder/tests/hard_cases/hard_cases_test" >>"$log" 2>&1 </dev/null || code=$?
    # "[  PASSED  ] 98 tests." counts neither those that failed nor those that were skipped.
    tests=$(sed -nE 's/^\[  PASSED  \] ([0-9]+) tests?\.$/\1/p' "$log" | tail -n 1)
    skipped=$(sed -nE 's/^\[  SKIPPED \] ([0-9]+) tests?, listed below:$/\1/p' "$log" | tail -n 1)
    if [[ $code -ne 0 || ${tests:-0} -eq 0 ]]; then
        failure "$1" "exit code $code" "$log"
        return 1
    fi
    echo "$1: passed, $tests tests${skipped:+; $skipped are not promised with these flags}"
}

passed=0 failed=0
mkdir -p -- "$build"
for name in "${names[@]}"; do
    if try "$name"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
done
echo "$passed passed, $failed failed"
[[ $failed -eq 0 ]]
