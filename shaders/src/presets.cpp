// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/library.h>
#include <regain/shaders/document.h>
#include <regain/shaders/presets.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>

REGAIN_NAMESPACE_BEGIN
namespace shaders {

namespace fs = std::filesystem;

std::vector<fs::path> preset_folders()
{
    std::vector<fs::path> folders;
    if (const char* list = std::getenv("REGAIN_PRESETS"))
    {
        std::istringstream in(list);
        for (std::string folder; std::getline(in, folder, ':');)
            if (!folder.empty()) folders.emplace_back(folder);
    }
    for (const fs::path& tables : luts::table_folders())
        if (tables.filename() == "luts") folders.push_back(tables.parent_path() / "presets");
    folders.emplace_back(REGAIN_PRESETS_SOURCE);
    return folders;
}

std::vector<std::string> preset_names()
{
    std::set<std::string> names;
    for (const fs::path& folder : preset_folders())
    {
        std::error_code ec;
        for (const auto& file : fs::directory_iterator(folder, ec))
            if (file.path().extension() == ".mtlx") names.insert(file.path().stem().string());
    }
    return {names.begin(), names.end()};
}

fs::path preset_file(const std::string& name)
{
    for (const fs::path& folder : preset_folders())
    {
        const fs::path file = folder / (name + ".mtlx");
        std::error_code ec;
        if (fs::is_regular_file(file, ec)) return file;
    }
    std::string known;
    for (const std::string& one : preset_names()) known += (known.empty() ? "" : ", ") + one;
    throw DocumentError("there is neither a document nor a preset '" + name + "'; " +
                        (known.empty() ? "no preset is installed" : "there are " + known));
}

fs::path document_or_preset(const std::string& name)
{
    std::error_code ec;
    if (fs::exists(name, ec) || name.find('/') != std::string::npos ||
        fs::path(name).extension() == ".mtlx")
        return name;
    return preset_file(name);
}

}  // namespace shaders
REGAIN_NAMESPACE_END
