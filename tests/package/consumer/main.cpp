// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Calls something of every part that is linked; WITH_part says which are.

#include <regain/closures/version.h>

#ifdef WITH_luts
#include <regain/luts/replace_file.h>

#include <fstream>
#endif

#include <iostream>

int main()
{
    std::cout << "Regain " << REGAIN_VERSION_STRING << '\n';

#ifdef WITH_luts
    regain::luts::replace_file("consumer.txt", [](const std::filesystem::path& path) {
        std::ofstream(path) << "written whole\n";
    });
    std::cout << "luts: wrote " << std::filesystem::file_size("consumer.txt") << " bytes\n";
#endif
}
