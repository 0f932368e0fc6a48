// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include <regain/luts/library.h>

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/exr.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>

REGAIN_NAMESPACE_BEGIN
namespace luts {
namespace {

namespace fs = std::filesystem;

// Tables stay where they are until the process ends: views of them are anywhere by then.
struct Library
{
    std::mutex mutex;
    std::map<std::string, std::unique_ptr<const Table>> tables;
    std::map<std::string, std::unique_ptr<const GridView<5>>> grids;
    std::map<std::string, DielectricAnisotropy> anisotropies;
    std::vector<fs::path> folders, loaded;
};

Library& library()
{
    static Library* const one = new Library;  // outlives the destructors of other statics
    return *one;
}

// The file that this code was loaded from: the shared library, or the program it is linked into.
fs::path own_file()
{
    Dl_info info;
    if (::dladdr(reinterpret_cast<const void*>(&table_folders), &info) == 0 || !info.dli_fname)
        return {};
    std::error_code ec;
    const fs::path file = fs::canonical(info.dli_fname, ec);
    return ec ? fs::path() : file;
}

std::vector<fs::path> folders_of(const Library& lib)
{
    std::vector<fs::path> folders = lib.folders;
    if (const char* list = std::getenv("REGAIN_LUTS"))
    {
        std::istringstream in(list);
        for (std::string folder; std::getline(in, folder, ':');)
            if (!folder.empty()) folders.emplace_back(folder);
    }
    if (const fs::path own = own_file(); !own.empty())
        for (const char* up : {REGAIN_LUTS_FROM_LIBRARY, REGAIN_LUTS_FROM_PROGRAM})
            folders.push_back((own.parent_path() / up).lexically_normal());
    folders.emplace_back(REGAIN_LUTS_INSTALLED);
    folders.emplace_back(REGAIN_LUTS_SOURCE);

    std::vector<fs::path> different;
    for (const fs::path& folder : folders)
        if (std::find(different.begin(), different.end(), folder) == different.end())
            different.push_back(folder);
    return different;
}

std::string bake_command(const std::string& name)
{
    return "; 'regain bake " + name + " -o FOLDER' bakes it, and REGAIN_LUTS=FOLDER finds it";
}

// Axes of a few tables may change without table_definition, which makes all of them stale.
bool has_axes_of(const std::string& name, const TableInfo& info)
{
    const TableInfo known = bakeable_info(name);
    return info.axis_x == known.axis_x && info.axis_y == known.axis_y &&
           info.axis_z == known.axis_z && info.axis_4 == known.axis_4 &&
           info.axis_5 == known.axis_5 && info.transform == known.transform;
}

Table load(Library& lib, const std::string& name)
{
    std::string places;
    for (const fs::path& folder : folders_of(lib))
    {
        const fs::path file = folder / (name + ".exr");
        std::error_code ec;
        if (!fs::exists(file, ec))
        {
            places += (places.empty() ? "" : ", ") + folder.string();
            continue;
        }
        lib.loaded.push_back(file);
        try
        {
            Table table = read_table(file);
            if (table.name() != name)
                throw std::runtime_error("cannot use table '" + file.string() + "': it holds '" +
                                         table.name() + "'");
            if (!has_axes_of(name, table.info()))
                throw std::runtime_error("cannot use table '" + file.string() +
                                         "': it was baked over other axes than this library has");
            return table;
        }
        catch (const std::runtime_error& e)
        {
            throw std::runtime_error(e.what() + bake_command(name));
        }
    }
    throw std::runtime_error("there is no table '" + name + ".exr' in " + places +
                             bake_command(name));
}

const Table& loaded(const std::string& name)
{
    require_bakeable(name);
    Library& lib = library();
    const std::lock_guard<std::mutex> lock(lib.mutex);
    auto& table = lib.tables[name];
    if (!table) table = std::make_unique<const Table>(load(lib, name));
    return *table;
}

const GridView<5>* loaded_grid(const std::string& name)
{
    const Table& table = loaded(name);
    Library& lib = library();
    const std::lock_guard<std::mutex> lock(lib.mutex);
    auto& grid = lib.grids[name];
    if (!grid) grid = std::make_unique<const GridView<5>>(table.grid<5>());
    return grid.get();
}

bool is_logarithmic(const Table& table) { return table.info().transform == "ln"; }

}  // namespace

void set_table_folders(std::vector<fs::path> folders)
{
    Library& lib = library();
    const std::lock_guard<std::mutex> lock(lib.mutex);
    lib.folders = std::move(folders);
}

std::vector<fs::path> table_folders()
{
    Library& lib = library();
    const std::lock_guard<std::mutex> lock(lib.mutex);
    return folders_of(lib);
}

TableView table_named(const std::string& name)
{
    const TableView builtin = builtin_table(name);
    return builtin ? builtin : loaded(name).view();
}

MicrofacetTables microfacet_tables(const std::string& distribution)
{
    if (distribution == "ggx") return ggx_tables();
    MicrofacetTables tables;
    tables.E_ss = loaded(distribution + "_E_ss").view();
    tables.E_avg = loaded(distribution + "_E_avg").view();
    tables.falloff = loaded(distribution + "_falloff").view();
    tables.dip = loaded(distribution + "_dip").view();
    tables.logarithmic = is_logarithmic(loaded(distribution + "_E_ss"));
    return tables;
}

void add_later_bounces(MicrofacetTables& tables, const std::string& distribution)
{
    tables.q_ms = table_named(distribution + "_q_ms");
    tables.mu_ms = table_named(distribution + "_mu_ms");
}

void add_balance(MicrofacetTables& tables, const std::string& distribution)
{
    tables.balance = table_named(distribution + "_balance");
}

void add_balance_anisotropy(MicrofacetTables& tables, const std::string& distribution)
{
    tables.balance_anisotropy = loaded_grid(distribution + "_balance_anisotropy");
}

void add_anisotropy(MicrofacetTables& tables, const std::string& distribution)
{
    tables.anisotropy = loaded_grid(distribution + "_anisotropy");
}

void add_later_shape(MicrofacetTables& tables, const std::string& distribution)
{
    tables.spread = table_named(distribution + "_spread");
    tables.forward = table_named(distribution + "_forward");
    tables.tilt = table_named(distribution + "_tilt");
}

DielectricTables dielectric_tables(const std::string& distribution, TransmissionShadowing shadowing,
                                   double gamma)
{
    TableInfo info;
    info.distribution = distribution;
    info.gamma = distribution == "gtr" || distribution == "std" ? gamma : 0;
    info.transmission_shadowing = shadowing == TransmissionShadowing::beta ? "beta" : "correlated";
    DielectricTables tables;
    tables.near_index = shadowing == TransmissionShadowing::beta;
    tables.tail = info.gamma != 0;
    for (int side = 0; side < 2; ++side)
    {
        info.side = side == 0 ? "outside" : "inside";
        info.quantity = "E_S";
        const Table& sum = loaded(table_name(info));
        tables.E[side] = sum.view();
        tables.logarithmic = is_logarithmic(sum);
        info.quantity = "R_share";
        tables.R[side] = loaded(table_name(info)).view();
    }
    return tables;
}

void add_later_split(DielectricTables& tables, const std::string& distribution, double gamma)
{
    const std::vector<std::string> names = later_split_table_names(distribution, gamma);
    for (std::size_t side = 0; side < 2; ++side) tables.later[side] = loaded(names[side]).view();
}

void add_anisotropy(DielectricTables& tables, const std::string& distribution,
                    TransmissionShadowing shadowing)
{
    if (distribution == "gtr" || distribution == "std") return;
    const std::string form = shadowing == TransmissionShadowing::beta ? "beta" : "correlated",
                      name = distribution + "_anisotropy_" + form;
    DielectricAnisotropy views;
    for (std::size_t side = 0; side < 2; ++side)
        views.change[side] = loaded(name + (side == 0 ? "_outside" : "_inside")).grid<5>();
    Library& lib = library();
    const std::lock_guard<std::mutex> lock(lib.mutex);
    tables.anisotropy = &lib.anisotropies.emplace(name, views).first->second;
}

std::vector<fs::path> loaded_files()
{
    Library& lib = library();
    const std::lock_guard<std::mutex> lock(lib.mutex);
    return lib.loaded;
}

}  // namespace luts
REGAIN_NAMESPACE_END
