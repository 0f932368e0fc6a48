#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# What the launcher does about set-up, seen from a copy of it in a folder of its own: every program
# it calls is a stand-in that writes down how it was called.
#
# launcher.sh SOURCE SCRATCH [PROGRAM]

set -euo pipefail

source=$1 scratch=$2 program=${3-}
rm -rf -- "$scratch"
mkdir -p "$scratch/bin" "$scratch/tree/closures/include/regain/closures" \
    "$scratch/tree/tests/hard_cases"
tree=$(cd -- "$scratch/tree" && pwd -P)
bin=$(cd -- "$scratch/bin" && pwd -P)
cp "$source/regain" "$source/CMakePresets.json" "$tree/"
cp "$source/tests/hard_cases/matrix.sh" "$tree/tests/hard_cases/"
cp "$source/closures/include/regain/closures/version.h" "$tree/closures/include/regain/closures/"

failures=0
check() {
    local what=$1
    shift
    if "$@"; then
        echo "ok: $what"
    else
        echo "FAILED: $what"
        echo "--- calls";  cat "$scratch/calls"
        echo "--- stdout"; cat "$scratch/stdout"
        echo "--- stderr"; cat "$scratch/stderr"
        failures=$((failures + 1))
    fi
}

stand_in() {
    { echo '#!/usr/bin/env bash'; echo "echo \"${1##*/} \$*\" >>'$scratch/calls'"; cat; } >"$bin/$1"
    chmod +x "$bin/$1"
}

# Packages are installed when they are named in the file `installed`.
stand_in dpkg-query <<END
grep -qxF -- "\${!#}" '$scratch/installed' && echo installed
END
stand_in apt-get <<END
[[ \$* != *install\ * ]] || printf '%s\n' "\$@" >>'$scratch/installed'
cat  # must find standard input empty, not the command's
END
stand_in id <<END
cat '$scratch/uid'
END
stand_in cmake <<END
if [[ \$1 == --preset ]]; then
    mkdir -p '$tree/build/release'
    [[ ! -e '$scratch/cmake-fails' ]] || { echo 'no such library'; exit 1; }
    touch '$tree/build/release/build.ninja'
    echo 'CMAKE_HOME_DIRECTORY:INTERNAL=$tree' >'$tree/build/release/CMakeCache.txt'
    echo "\${!#}" | sed 's/^-D//; s/=/:BOOL=/' >>'$tree/build/release/CMakeCache.txt'
elif [[ \$1 == -S ]]; then
    echo "\$*" | grep -q -- '-DREGAIN_BUILD_TESTS=ON' && mkdir -p "\$4/tests/hard_cases"
elif [[ \$2 == */matrix/* ]]; then
    [[ \$2 != */g++-O2 ]] || { echo 'a.cpp:1: error: expected something'; exit 1; }
    cat >"\$2/tests/hard_cases/hard_cases_test" <<'PROGRAM'
#!/usr/bin/env bash
echo '[  PASSED  ] 5 tests.'
[[ \$0 != *fast-math* ]] || echo '[  SKIPPED ] 2 tests, listed below:'
[[ \$0 != *traps* ]] || kill -FPE \$\$
PROGRAM
    chmod +x "\$2/tests/hard_cases/hard_cases_test"
elif [[ -e '$scratch/build-fails' ]]; then
    echo '[1/2] Building a.o'
    echo 'a.cpp:1: error: expected something'
    exit 1
else
    mkdir -p '$tree/build/release/tools'
    printf '#!/usr/bin/env bash\necho "ran: \$*"; cat; exit 7\n' >'$tree/build/release/tools/regain'
    chmod +x '$tree/build/release/tools/regain'
fi
END
stand_in ninja <<<''
stand_in c++ <<<''
stand_in g++ <<<''
stand_in clang++ <<END
[[ -e '$scratch/clang-sanitizes' ]]
END
stand_in ctest <<END
cat '$scratch/ctest-says'
exit "\$(cat '$scratch/ctest-exit')"
END

# launch INPUT ARGUMENT...: sets `code`, fills calls, stdout and stderr.
launch() {
    local input=$1
    shift
    : >"$scratch/calls"
    code=0
    env -u CXX PATH="$bin:$PATH" "$tree/regain" "$@" \
        <<<"$input" >"$scratch/stdout" 2>"$scratch/stderr" || code=$?
}
called() { grep -qE -- "$1" "$scratch/calls"; }
not() { ! "$@"; }
exits() { [[ $code -eq $1 ]]; }
says() { grep -qE -- "$2" "$scratch/$1"; }
calls_nothing() { [[ ! -s $scratch/calls ]]; }
silent() { [[ ! -s $scratch/$1 ]]; }
answers() { [[ $(<"$scratch/stdout") == "$1" ]]; }
in_order() { [[ $(tr '\n' ' ' <"$scratch/calls") =~ $1.*$2 ]]; }
last_line() { [[ $(tail -n 1 "$scratch/stdout") == "$1" ]]; }

: >"$scratch/installed"

launch '' --help
check 'help lists the commands' says stdout '^  render'
check 'help needs no set-up' calls_nothing
launch '' --version
check 'the version is told' says stdout '^regain [0-9.]+$'
check 'the version needs no set-up' calls_nothing
launch '' rendre
check 'an unknown command is named' says stderr "no command 'rendre'"
check 'an unknown command is bad input' exits 2
check 'an unknown command is refused before any set-up' calls_nothing
launch ''
check 'no command is bad input' exits 2

echo 1000 >"$scratch/uid"
launch '' render
check 'without root the missing packages are named and the exit code is 2' exits 2
check 'the line to run stands alone' says stderr \
    '^sudo apt-get update && sudo apt-get install -y --no-install-recommends libimath-dev .*fonts-dejavu-core$'
check 'without root nothing is installed' not called '^apt-get'
check 'render does not ask for GoogleTest' not says stderr gtest
launch '' test
check 'test asks for GoogleTest' says stderr 'libgtest-dev$'

echo 0 >"$scratch/uid"
launch 'a line' render --spp 4
check 'root installs what is missing' called '^apt-get .*install -y --no-install-recommends libimath-dev '
check 'the package lists are brought up to date first' in_order ' update ' ' install '
check 'render is configured without tests' called '^cmake --preset release -DREGAIN_BUILD_TESTS=OFF$'
check 'render builds the program only' called '^cmake --build .*--target regain$'
check 'the program gets the arguments and standard input' \
    answers $'ran: render --spp 4\na line'
check 'the exit code is that of the program' exits 7

launch '' render
check 'a second call installs nothing' not called '^apt-get'
check 'a second call configures nothing' not called '^cmake --preset'
check 'a second call says nothing of its own' silent stderr

echo libgtest-dev >>"$scratch/installed"
echo 0 >"$scratch/ctest-exit"
echo '100% tests passed, 0 tests failed out of 12' >"$scratch/ctest-says"
launch '' test -R name
check 'the first test switches tests on' called '^cmake --preset release -DREGAIN_BUILD_TESTS=ON$'
check 'arguments go to ctest' called '^ctest .*-R name$'
check 'passed tests give exit code 0' exits 0
check 'the last line counts' last_line '12 passed, 0 failed'
launch '' render
check 'render leaves tests switched on' not called '^cmake --preset'
launch '' test
check 'a second test configures nothing' not called '^cmake --preset'

echo 8 >"$scratch/ctest-exit"
echo '75% tests passed, 3 tests failed out of 12' >"$scratch/ctest-says"
launch '' test
check 'failed tests give exit code 1' exits 1
check 'failed tests are counted' last_line '9 passed, 3 failed'
printf '%s\n' '100% tests passed, 0 tests failed out of 3' 'The following tests did not run:' \
    $'\t  2 - a.name (Skipped)' >"$scratch/ctest-says"
echo 0 >"$scratch/ctest-exit"
launch '' test
check 'skipped tests do not count as passed' last_line '2 passed, 0 failed'
echo 8 >"$scratch/ctest-exit"
echo 'No tests were found!!!' >"$scratch/ctest-says"
launch '' test
check 'no tests are a failure' exits 1
check 'no tests are counted as none' last_line '0 passed, 0 failed'

# The matrix: a build that fails and a program that is stopped keep nothing from being tried.
launch '' test --help
check 'the help of test tells of the matrix' says stdout '--matrix'
check 'the help of test lists its configurations' says stdout 'clang\+\+-fast-math'
check 'the help of test needs no set-up' calls_nothing
launch '' test --matrix g++-O7
check 'an unknown configuration is bad input' exits 2
check 'an unknown configuration is named, and those there are' \
    says stderr "no configuration 'g\+\+-O7'.* g\+\+-O2 "
check 'an unknown configuration is refused before any set-up' calls_nothing
echo 1000 >"$scratch/uid"
launch '' test --matrix
check 'without root the matrix names the packages it misses' exits 2
check 'the line to run for the matrix stands alone' says stderr '^sudo .* libclang-rt-dev$'
check 'without what it needs the matrix builds nothing' not called '^cmake'
echo 0 >"$scratch/uid"
touch "$scratch/clang-sanitizes"
launch '' test --matrix
check 'with both compilers the matrix installs nothing' not called '^apt-get'
check 'the matrix does not configure the release build' not called '^cmake --preset'
check 'the matrix configures for g++' called '^cmake .*-DCMAKE_CXX_COMPILER=g\+\+ '
check 'the matrix configures for clang++' called '^cmake .*-DCMAKE_CXX_COMPILER=clang\+\+ '
check 'the matrix builds the hard cases only' called '^cmake --build .*--target hard_cases_test$'
check 'a configuration that passes has a line' says stdout '^g\+\+-O0: passed, 5 tests$'
check 'what is not promised is told' \
    says stdout '^clang\+\+-fast-math: passed, 5 tests; 2 are not promised with these flags$'
check 'a configuration that does not build has a line' says stdout '^g\+\+-O2: FAILED, .*build'
check 'what the compiler said of it is shown' says stderr 'expected something'
check 'a program that is stopped has a line' says stdout '^clang\+\+-traps: FAILED, exit code 136'
check 'the matrix counts in its last line' last_line '9 passed, 3 failed'
check 'a failed configuration gives exit code 1' exits 1
launch '' test --matrix clang++-O2 g++-sanitize
check 'only those that are named run' last_line '2 passed, 0 failed'
check 'passed configurations give exit code 0' exits 0

touch "$scratch/build-fails"
launch '' render
check 'a failed build gives exit code 1' exits 1
check 'a failed build shows what the compiler said' says stderr 'expected something'
check 'a failed build names the full log' says stderr 'build/build.log'
check 'a failed build runs nothing' silent stdout
rm "$scratch/build-fails"

touch "$scratch/cmake-fails" && rm -r "$tree/build/release"
launch '' render
check 'a failed configuration gives exit code 1' exits 1
check 'a failed configuration shows why' says stderr 'no such library'
rm "$scratch/cmake-fails"
launch '' render
check 'after a failed configuration the next call configures' called '^cmake --preset'

sed -i 's|DIRECTORY:INTERNAL=.*|DIRECTORY:INTERNAL=/elsewhere|' "$tree/build/release/CMakeCache.txt"
launch '' render
check 'a build folder from elsewhere is configured anew' called '^cmake --preset'

# The list of commands in the launcher's help is that of the program, `test` apart.
if [[ -n $program ]]; then
    "$program" --help 2>/dev/null | sed -n '/^Subcommands:/,$p' |
        sed -nE 's/^  ([a-z][a-z-]*) .*/\1/p' | sort >"$scratch/of-program"
    "$source/regain" --help | sed -n '/^commands:/,/^$/p' |
        sed -nE 's/^  ([a-z][a-z-]*) .*/\1/p' | grep -vx test | sort >"$scratch/of-launcher"
    if [[ -s $scratch/of-program ]]; then
        check 'the launcher lists the commands of the program' \
            diff "$scratch/of-program" "$scratch/of-launcher"
    fi
fi

echo "$failures failed"
[[ $failures -eq 0 ]]
