#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# Which lines and branches of closures/ and luts/ the tests reach: prints the table of
# docs/coverage.md, and then the lines that are not reached.
#
#     tests/coverage.sh [JOBS]
#
# It builds the preset `coverage`, runs the tests that compute, and asks gcovr. Pictures, packages and
# the conformance kit's checks of every closure are left out, for they take an hour.

set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
build=$root/build/coverage jobs=${1:-2}
cd -- "$root"

cmake --preset coverage >&2
cmake --build "$build" --parallel "$jobs" --target closures_test luts_test hard_cases_test \
    adapters_test fuzz_closure_inputs_test fuzz_query_line_test fuzz_table_file_test \
    regain kit_test regain_test_tools >&2

# Counts add up from run to run: what other tests reached would stay in.
find "$build" -name '*.gcda' -delete
ctest --test-dir "$build" --parallel "$jobs" --output-on-failure --no-tests=error \
    -R '^(closures|luts|hard_cases|adapters|tools|fuzz)\.' >&2

gcovr --root "$root" --filter closures/ --filter luts/ -j "$jobs" --exclude-throw-branches \
    --exclude-unreachable-branches --csv "$build/coverage.csv" --txt "$build/coverage.txt" \
    --html-details "$build/coverage.html" "$build" >&2

awk -F , '
    function percent(part, all) { return all ? sprintf("%.1f", 100 * part / all) : "" }
    function row(name, lines, hit, branches, taken) {
        printf "| %s | %d of %d | %s | %d of %d | %s |\n", name, hit, lines, percent(hit, lines),
            taken, branches, percent(taken, branches)
    }
    NR > 1 && $2 > 0 {
        sub(/include\/regain\/(closures|luts)\//, "", $1)
        file[++n] = $1
        sub(/\/.*/, "", $1)
        folder[n] = $1
        lines[n] = $2; hit[n] = $3; branches[n] = $5; taken[n] = $6
        all_lines[$1] += $2; all_hit[$1] += $3; all_branches[$1] += $5; all_taken[$1] += $6
    }
    END {
        print "| file | lines | % | branches | % |\n|---|---|---|---|---|"
        for (i = 1; i <= n; ++i) {
            f = folder[i]
            if (f != folder[i - 1])
                row("**" f "/**", all_lines[f], all_hit[f], all_branches[f], all_taken[f])
            row(file[i], lines[i], hit[i], branches[i], taken[i])
        }
    }' "$build/coverage.csv"

printf '\nnot reached:\n'
# A long name stands on a line of its own.
awk 'NF == 1 && /\// { name = $1; next }
     /%/ && $NF !~ /%/ && !/^TOTAL/ { print (NF == 5 ? $1 : name) ": " $NF }' "$build/coverage.txt"
