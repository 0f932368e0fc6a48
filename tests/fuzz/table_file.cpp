// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Table files: whatever one holds, reading it gives a table whose look-ups are finite, or an error
// that names the file.

#include "target.h"

#include <regain/luts/bake.h>
#include <regain/luts/exr.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace regain;

namespace {

namespace fs = std::filesystem;

// One file for all inputs, in memory where the system has such a folder.
const fs::path& file()
{
    static const fs::path path =
        (fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
        ("regain-fuzz-" + std::to_string(::getpid()) + ".exr");
    return path;
}

struct Remover
{
    ~Remover()
    {
        std::error_code ec;
        fs::remove(file(), ec);
    }
} remover;

void check(const luts::Table& table)
{
    const TableView view = table.view();
    if (!std::isfinite(luts::interpolated(table, {0.37, 0.61, 0.5, 0.23, 0.78})))
        fuzz::fault("a table that was accepted gives no finite number");
    for (const double x : {0.0, 0.37, 1.0})
        for (const double y : {0.0, 0.61, 1.0})
            if (!std::isfinite(luts::interpolated(view, {x, y, 0.5})))
                fuzz::fault("a table that was accepted gives no finite number");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    {
        std::ofstream out(file(), std::ios::binary | std::ios::trunc);
        out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    try
    {
        check(luts::read_table(file()));
    }
    catch (const std::runtime_error& e)
    {
        if (std::string(e.what()).find(file().string()) == std::string::npos)
            fuzz::fault(std::string("an error does not name the file: ") + e.what());
    }
    return 0;
}
