// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "plugin_material.h"

#include "../errors.h"
#include "osl_shader.h"

#include <regain/clarisse/plugin.h>
#include <regain/osl/plugin.h>
#include <regain/renderman/plugin.h>

#include <fmt/format.h>

#include <dlfcn.h>

#include <charconv>
#include <cstring>
#include <filesystem>
#include <set>
#include <string_view>

namespace regain::tools::preview {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& file, const std::string& why)
{
    throw BadInput(fmt::format("--plugin {}: {}", file, why));
}

std::shared_ptr<void> opened(const std::string& file)
{
    std::error_code ec;
    if (!fs::exists(file, ec)) fail(file, "there is no such file");
    if (fs::is_directory(file, ec)) fail(file, "it is a folder");
    // A name without a slash would be looked for elsewhere.
    void* handle = dlopen(fs::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle)
    {
        const char* why = dlerror();
        fail(file, fmt::format("it cannot be loaded as a shared object ({})",
                               why ? why : "no reason was given"));
    }
    return {handle, [](void* h) { dlclose(h); }};
}

// The version comes first: of another, nothing else is known to be there.
template <class Plugin>
void require_usable(const std::string& file, const Plugin* plugin)
{
    if (!plugin) fail(file, "its function for hosts returns null");
    if (plugin->version != Plugin::current)
        fail(file, fmt::format("it was written for version {} of the interface; this host knows {}",
                               plugin->version, int(Plugin::current)));
    if (!plugin->library || std::strcmp(plugin->library, REGAIN_VERSION_STRING) != 0)
        fail(file,
             fmt::format("it was built with version {} of the library; this host is {}",
                         plugin->library ? plugin->library : "(none)", REGAIN_VERSION_STRING));
    if (!plugin->name) fail(file, "it has no name");
}

void require_functions(const std::string& file, std::initializer_list<bool> there)
{
    for (const bool one : there)
        if (!one) fail(file, "one of its functions is null");
}

std::string described(const ParameterInfo& p)
{
    return fmt::format("{} in [{:g}, {:g}]", p.components == 3 ? "R,G,B, each" : "a number",
                       p.least, p.most);
}

void set(ParameterValue& value, const ParameterInfo& p, const std::string& setting,
         std::string_view text)
{
    const auto refuse = [&] {
        throw BadInput(fmt::format("--set {}: {} takes {}", setting, p.name, described(p)));
    };
    for (int k = 0; k < p.components; ++k)
    {
        const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value.v[k]);
        // Written so that NaN is refused, too.
        if (ec != std::errc() || !(value.v[k] >= p.least && value.v[k] <= p.most)) refuse();
        text.remove_prefix(std::size_t(end - text.data()));
        if (k + 1 == p.components) break;
        if (text.empty() || text[0] != ',') refuse();
        text.remove_prefix(1);
    }
    if (!text.empty()) refuse();
}

std::vector<ParameterValue> values_of(const std::string& file, const ParameterInfo* parameters,
                                      int count, const std::vector<std::string>& settings)
{
    if (count < 0 || (count > 0 && !parameters)) fail(file, "its list of parameters is broken");
    std::vector<ParameterValue> values;
    for (int i = 0; i < count; ++i)
    {
        const ParameterInfo& p = parameters[i];
        if (!p.name || (p.components != 1 && p.components != 3))
            fail(file, fmt::format("its parameter {} is broken", i));
        values.push_back({{p.initial[0], p.initial[1], p.initial[2]}});
    }
    std::set<std::string> seen;
    for (const std::string& setting : settings)
    {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos)
            throw BadInput(fmt::format("--set {}: takes NAME=VALUE", setting));
        const std::string name = setting.substr(0, equals);
        int at = 0;
        while (at < count && parameters[at].name != name) ++at;
        if (at == count)
        {
            std::vector<std::string> names;
            for (int i = 0; i < count; ++i) names.push_back(parameters[i].name);
            throw BadInput(fmt::format("--set {}: the plug-in has no such parameter; there are {}",
                                       setting, fmt::join(names, ", ")));
        }
        if (!seen.insert(name).second)
            throw BadInput(fmt::format("--set {}: {} is set twice", setting, name));
        set(values[std::size_t(at)], parameters[at], setting,
            std::string_view(setting).substr(equals + 1));
    }
    return values;
}

[[noreturn]] void unusable(const std::string& file, const char* error)
{
    fail(file,
         fmt::format("its material cannot be made: {}", error ? error : "it does not say why"));
}

[[noreturn]] void wrong_host(const char* wanted)
{
    throw std::logic_error(fmt::format("this plug-in is of the host {}", wanted));
}

class BoundBxdf final : public BoundMaterial
{
public:
    BoundBxdf(std::shared_ptr<void> library, const renderman::BxdfPlugin& plugin,
              const std::string& file, const std::vector<ParameterValue>& values)
        : _library(std::move(library)), _plugin(plugin)
    {
        const char* error = nullptr;
        _data = plugin.create_instance_data(values.data(), &error);
        if (!_data) unusable(file, error);
        _factory = plugin.create_factory();
        if (_factory) return;
        plugin.destroy_instance_data(_data);
        unusable(file, "no factory");
    }
    ~BoundBxdf() override
    {
        _plugin.destroy_factory(_factory);
        _plugin.destroy_instance_data(_data);
    }
    GridMaterial grid() override { return {_factory, _data}; }
    PointMaterial point() override { wrong_host("renderman"); }
    OslMaterial osl() override { wrong_host("renderman"); }

private:
    std::shared_ptr<void> _library;  // is let go last
    const renderman::BxdfPlugin& _plugin;
    renderman::Factory* _factory = nullptr;
    void* _data = nullptr;
};

class BoundModule final : public BoundMaterial
{
public:
    BoundModule(std::shared_ptr<void> library, const clarisse::MaterialModule& module,
                const std::string& file, const std::vector<ParameterValue>& values)
        : _library(std::move(library)), _module(module)
    {
        const char* error = nullptr;
        _object = module.create_object(values.data(), &error);
        if (!_object) unusable(file, error);
    }
    ~BoundModule() override { _module.destroy_object(_object); }
    GridMaterial grid() override { wrong_host("clarisse"); }
    PointMaterial point() override { return {&_module.callbacks, _object}; }
    OslMaterial osl() override { wrong_host("clarisse"); }

private:
    std::shared_ptr<void> _library;
    const clarisse::MaterialModule& _module;
    void* _object = nullptr;
};

class PluginShader final : public OslShader
{
public:
    PluginShader(const osl::ShaderPlugin& plugin, const std::string& file,
                 const std::vector<ParameterValue>& values)
        : OslShader(osl::ClosureLibrary(osl::LibrarySettings{})), _plugin(plugin)
    {
        const char* error = nullptr;
        _shader = plugin.create_shader(values.data(), &error);
        if (!_shader) unusable(file, error);
    }
    ~PluginShader() override { _plugin.destroy_shader(_shader); }

    const osl::ClosureColor* shade(const osl::ShaderGlobals& globals,
                                   osl::NodePool& pool) const override
    {
        return _plugin.shade(_shader, globals, pool);
    }
    // Nobody says that it does not.
    bool lets_by() const override { return true; }

private:
    const osl::ShaderPlugin& _plugin;
    void* _shader = nullptr;
};

class BoundShader final : public BoundMaterial
{
public:
    BoundShader(std::shared_ptr<void> library, const osl::ShaderPlugin& plugin,
                const std::string& file, const std::vector<ParameterValue>& values)
        : _library(std::move(library)), _shader(plugin, file, values)
    {}
    GridMaterial grid() override { wrong_host("osl"); }
    PointMaterial point() override { wrong_host("osl"); }
    OslMaterial osl() override { return {&_shader}; }

private:
    std::shared_ptr<void> _library;
    PluginShader _shader;
};

}  // namespace

PluginMaterial load_plugin(const std::string& file, const std::vector<std::string>& settings)
{
    const std::shared_ptr<void> library = opened(file);
    const auto function = [&](const char* name) { return dlsym(library.get(), name); };
    if (void* f = function(REGAIN_BXDF_PLUGIN))
    {
        // POSIX has a function's address come out as an object's.
        const auto* plugin = reinterpret_cast<renderman::BxdfPluginFunction>(f)();
        require_usable(file, plugin);
        const auto values = values_of(file, plugin->parameters, plugin->parameter_count, settings);
        require_functions(
            file,
            {plugin->create_factory != nullptr, plugin->destroy_factory != nullptr,
             plugin->create_instance_data != nullptr, plugin->destroy_instance_data != nullptr});
        return {Host::renderman, plugin->name,
                std::make_unique<BoundBxdf>(library, *plugin, file, values)};
    }
    if (void* f = function(REGAIN_MATERIAL_MODULE))
    {
        const auto* module = reinterpret_cast<clarisse::MaterialModuleFunction>(f)();
        require_usable(file, module);
        const auto values = values_of(file, module->attributes, module->attribute_count, settings);
        require_functions(file,
                          {module->create_object != nullptr, module->destroy_object != nullptr,
                           module->callbacks.create_module_data != nullptr,
                           module->callbacks.destroy_module_data != nullptr,
                           module->callbacks.create_lobes != nullptr});
        return {Host::clarisse, module->name,
                std::make_unique<BoundModule>(library, *module, file, values)};
    }
    if (void* f = function(REGAIN_SHADER_PLUGIN))
    {
        const auto* plugin = reinterpret_cast<osl::ShaderPluginFunction>(f)();
        require_usable(file, plugin);
        const auto values = values_of(file, plugin->parameters, plugin->parameter_count, settings);
        require_functions(file, {plugin->create_shader != nullptr,
                                 plugin->destroy_shader != nullptr, plugin->shade != nullptr});
        return {Host::osl, plugin->name,
                std::make_unique<BoundShader>(library, *plugin, file, values)};
    }
    fail(file, "it exports neither " REGAIN_BXDF_PLUGIN " nor " REGAIN_MATERIAL_MODULE
               " nor " REGAIN_SHADER_PLUGIN
               "; see plugin.h of the adapters (in C++ they have to be extern \"C\")");
}

}  // namespace regain::tools::preview
