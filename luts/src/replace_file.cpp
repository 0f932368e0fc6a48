// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/replace_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

REGAIN_NAMESPACE_BEGIN
namespace luts {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& target, const std::string& why)
{
    throw std::runtime_error("cannot write '" + target.string() + "': " + why);
}

fs::path temporary_beside(const fs::path& target)
{
    return target.parent_path() / (target.stem().string() + ".part" + std::to_string(::getpid()) +
                                   target.extension().string());
}

}  // namespace

void require_replaceable(const fs::path& target)
{
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code ec;
    if (!fs::exists(folder, ec)) fail(target, "there is no folder '" + folder.string() + "'");
    if (!fs::is_directory(folder, ec)) fail(target, "'" + folder.string() + "' is not a folder");
    if (fs::is_directory(target, ec)) fail(target, "it is a folder");

    const fs::path temporary = temporary_beside(target);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
        fail(target, "the folder takes no file (" + std::string(std::strerror(errno)) + ")");
    ::close(file);
    fs::remove(temporary, ec);
}

void replace_file(const fs::path& target, const std::function<void(const fs::path&)>& write)
{
    require_replaceable(target);
    const fs::path temporary = temporary_beside(target);
    std::error_code ec;
    try
    {
        write(temporary);
        if (!fs::exists(temporary, ec)) fail(target, "nothing was written");
        fs::rename(temporary, target, ec);
        if (ec) fail(target, ec.message());
    }
    catch (...)
    {
        fs::remove(temporary, ec);
        throw;
    }
}

}  // namespace luts
REGAIN_NAMESPACE_END
