// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "bake_verify.h"

#include "bake_table.h"
#include "errors.h"
#include "json_fields.h"
#include "table_check.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/exr.h>
#include <regain/luts/library.h>

#include <fmt/format.h>

#include <algorithm>

namespace regain::tools {
namespace {

struct ShippedFile
{
    std::string file;
    luts::Table table;
};

std::vector<TableCheck> check_table(const std::string& name, const std::vector<ShippedFile>& files,
                                    int spots, const InterruptGuard& guard)
{
    std::vector<TableCheck> checks;
    const TableView builtin = luts::builtin_table(name);
    if (spots > 0)
    {
        if (builtin)
            checks.push_back(
                check_spots(name, builtin, spot_tolerance(name), "compiled in", spots));
        for (const ShippedFile& f : files)
            if (f.table.name() == name) checks.push_back(check_spots(f.table, f.file, spots));
        return checks;
    }
    const luts::Table baked = bake_showing(name, guard);
    if (builtin) checks.push_back(check_builtin(baked));
    for (const ShippedFile& f : files)
        if (f.table.name() == name) checks.push_back(check_file(baked, f.table, f.file));
    return checks;
}

// The file that the library would load.
std::string installed_file(const std::string& name)
{
    for (const std::filesystem::path& folder : luts::table_folders())
        if (const auto file = folder / (name + ".exr"); std::filesystem::exists(file))
            return file.string();
    throw BadInput(
        fmt::format("there is no file of the table '{}' to verify; bake it with -o", name));
}

Json as_json(const TableCheck& c)
{
    Json json{{"table", c.table},         {"against", c.against},
              {"passed", c.passed()},     {"numbers", c.numbers},
              {"differing", c.differing}, {"largest_difference", c.largest_difference}};
    if (c.worst)
        json["worst"] = {{"where", c.worst->where},
                         {"shipped", c.worst->shipped},
                         {"expected", c.worst->expected}};
    return json;
}

void print(const TableCheck& c)
{
    fmt::print("{:<6} {:<18} {}: {} numbers, largest difference {:.1e}\n",
               c.passed() ? "same" : "DIFFER", c.table, c.against, c.numbers, c.largest_difference);
    if (c.worst)
        fmt::print("       {} differ, most at {}: shipped {}, expected {}\n", c.differing,
                   c.worst->where, c.worst->shipped, c.worst->expected);
}

}  // namespace

int verify_tables(const std::vector<std::string>& given_names, int spots, bool json,
                  const InterruptGuard& guard)
{
    std::vector<std::string> names;
    std::vector<ShippedFile> files;
    for (const std::string& given : given_names)
    {
        std::string name = given;
        if (!is_table(given))
        {
            files.push_back({given, luts::read_table(given)});
            name = files.back().table.name();
            luts::require_bakeable(name);
        }
        else if (!luts::builtin_table(given))
        {
            const std::string file = installed_file(given);
            files.push_back({file, luts::read_table(file)});
        }
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }

    Json report = Json::array();
    int failed = 0;
    for (const std::string& name : names.empty() ? luts::compiled_in_tables() : names)
        for (const TableCheck& check : check_table(name, files, spots, guard))
        {
            if (!json) print(check);
            report.push_back(as_json(check));
            failed += !check.passed();
        }
    if (json) fmt::print("{}\n", report.dump());
    if (failed > 0)
        throw CheckFailed(
            fmt::format("{} of {} tables are not what their definition says: bake "
                        "them again",
                        failed, report.size()));
    return kDone;
}

}  // namespace regain::tools
