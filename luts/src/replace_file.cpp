// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/replace_file.h>

#include <unistd.h>

#include <stdexcept>
#include <string>
#include <system_error>

REGAIN_NAMESPACE_BEGIN
namespace luts {

namespace fs = std::filesystem;

void replace_file(const fs::path& target, const std::function<void(const fs::path&)>& write)
{
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error("cannot write '" + target.string() + "': " + why);
    };

    std::error_code ec;
    if (!fs::is_directory(folder, ec)) fail("'" + folder.string() + "' is not a folder");
    if (fs::is_directory(target, ec)) fail("it is a folder");
    if (::access(folder.c_str(), W_OK) != 0) fail("the folder is not writable");

    const fs::path temporary = folder / (target.stem().string() + ".part" +
                                         std::to_string(::getpid()) + target.extension().string());
    try
    {
        write(temporary);
        if (!fs::exists(temporary, ec)) fail("nothing was written");
        fs::rename(temporary, target, ec);
        if (ec) fail(ec.message());
    }
    catch (...)
    {
        fs::remove(temporary, ec);
        throw;
    }
}

}  // namespace luts
REGAIN_NAMESPACE_END
