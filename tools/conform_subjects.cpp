// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "conform_subjects.h"

#include "any_closure.h"
#include "conform_promises.h"
#include "errors.h"

#include "table_check.h"

#include <regain/luts/bake.h>
#include <regain/luts/builtin.h>
#include <regain/luts/exr.h>
#include <regain/luts/library.h>

#include <filesystem>
#include <map>
#include <mutex>

namespace regain::tools {
namespace {

using conformance::Form;
using conformance::Parameters;
using conformance::Reads;
using conformance::TestedClosure;
using shaders::DistributionKind;

// An AnyClosure, whose answers are the closure's to the bit.
class Tested final : public TestedClosure
{
public:
    explicit Tested(std::unique_ptr<AnyClosure> closure) : _closure(std::move(closure)) {}

    Traits traits() const override { return _closure->traits(); }
    void prepare(const Imath::V3d& wo) override { _closure->prepare(wo); }
    ColorD eval(const Imath::V3d& wi, const Imath::V3d& u) const override
    {
        return _closure->eval(wi, u);
    }
    double pdf(const Imath::V3d& wi) const override { return _closure->pdf(wi); }
    Sample<double> sample(const Imath::V3d& u) const override { return _closure->sample(u); }
    Albedo<double> albedo() const override { return _closure->albedo(); }

private:
    std::unique_ptr<AnyClosure> _closure;
};

template <class Distribution>
class Normals final : public conformance::TestedNormals
{
public:
    explicit Normals(const Distribution& distribution) : _distribution(distribution) {}

    double D(const Imath::V3d& m) const override { return _distribution.D(m); }
    double projected_area(const Imath::V3d& w) const override
    {
        return _distribution.projected_area(w);
    }
    double G1(const Imath::V3d& w) const override { return _distribution.G1(w); }
    double G2(const Imath::V3d& wo, const Imath::V3d& wi) const override
    {
        return _distribution.G2(wo, wi);
    }
    Imath::V3d sample_visible(const Imath::V3d& wo, const Imath::V3d& u) const override
    {
        return _distribution.visible(wo).sample(u);
    }

private:
    Distribution _distribution;
};

// The file that was loaded.
luts::Table file_of(const std::string& table)
{
    for (const std::filesystem::path& folder : luts::table_folders())
        if (const auto file = folder / (table + ".exr"); std::filesystem::exists(file))
            return luts::read_table(file);
    throw BadInput("there is no file of the table " + table);
}

// Many subjects share a table, which is compared once.
conformance::TableError table_error(const std::string& table, int places)
{
    if (places == 0) return {table, {}, 0, 1};
    static std::mutex mutex;
    static std::map<std::pair<std::string, int>, conformance::TableError> known;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = known.find({table, places});
    if (found != known.end()) return found->second;
    const TableView view = luts::table_named(table);
    const SpotTolerance tolerance =
        luts::builtin_table(table) ? spot_tolerance(table) : spot_tolerance(file_of(table));
    const TableCheck check = check_spots(table, view, tolerance, "loaded", places);
    const conformance::TableError error{table, check.worst ? check.worst->where : "its worst place",
                                        check.largest_difference, tolerance.largest};
    return known[{table, places}] = error;
}

std::string name_of(const ClosureSpec& spec)
{
    std::string name(tools::name(spec.lobe));
    if (spec.plain)
    {
        const auto* diffuse = std::get_if<shaders::OrenNayarSurface>(&spec.plain->surface);
        if (diffuse && diffuse->energy_compensation) name += ".compensated";
        if (const auto* cloth = std::get_if<shaders::ClothSurface>(&spec.plain->surface))
            name += cloth->mode == shaders::ClothMode::zeltner ? ".zeltner" : ".conty_kulla";
        return name;
    }
    if (spec.combination)
        return name + "." + name_of(*spec.combination->first) + ".on." +
               name_of(*spec.combination->second);
    if (spec.interface.thin_walled) name = "thin_dielectric";
    if (spec.lobe != Lobe::sheen) name += "." + std::string(shaders::name(spec.distribution));
    name += "." + std::string(shaders::name(spec.method));
    if (spec.lobe != Lobe::dielectric) return name;
    if (spec.interface.shadowing == TransmissionShadowing::beta) name += ".beta";
    if (spec.interface.mode == ScatterMode::R) name += ".R";
    if (spec.interface.mode == ScatterMode::T) name += ".T";
    return name;
}

template <class Surface, class = void>
struct HasRoughness : std::false_type
{};
template <class Surface>
struct HasRoughness<Surface, std::void_t<decltype(std::declval<Surface&>().roughness)>>
    : std::true_type
{};

// Of dielectrics with a tail none are shipped.
bool has_albedo_tables(const ClosureSpec& spec)
{
    return !(spec.lobe == Lobe::dielectric && shaders::has_gamma(spec.distribution));
}

class BuiltIn final : public conformance::Subject
{
public:
    BuiltIn(const ClosureSpec& spec, const Subject* bare, const Subject* reference)
        : _spec(spec), _name(name_of(spec)), _bare(bare), _reference(reference)
    {}

    std::string name() const override { return _name; }

    Reads reads() const override
    {
        Reads r;
        r.single = r.twice = true;
        if (_spec.lobe == Lobe::sheen) return r;
        if (_spec.plain)
        {
            // Where it is rough, by the same number.
            r.alpha = has_roughness(*_spec.plain);
            r.one_medium = _spec.has_two_sides();
            return r;
        }
        r.alpha = r.two_alphas = true;
        r.gamma = shaders::has_gamma(_spec.distribution);
        if (r.gamma)
        {
            const bool gtr = _spec.distribution == DistributionKind::gtr;
            // Below 1.7, much of what STD sends anywhere it does by facets so nearly upright that
            // no number type tells their directions apart, and no quadrature: docs/support.md.
            r.lowest_gamma = gtr ? gtr_min_gamma : 1.7;
            r.highest_gamma = gtr ? gtr_max_gamma : std_max_gamma;
        }
        r.eta = _spec.lobe == Lobe::dielectric || _spec.combination;
        r.one_medium = _spec.interface.thin_walled;
        r.schlick = _spec.lobe == Lobe::generalized_schlick;
        r.conductor = _spec.lobe == Lobe::conductor;
        return r;
    }

    std::unique_ptr<TestedClosure> make(const Parameters& p) const override
    {
        ClosureSpec spec = specified(p);
        return std::make_unique<Tested>(make_closure(spec, has_albedo_tables(spec)));
    }

    conformance::Promises promises(const Parameters& p, const Imath::V3d& wo) const override
    {
        return promises_of(specified(p), wo);
    }
    const Subject* bare() const override { return _bare; }
    const Subject* reference() const override { return _reference; }
    Form form() const override
    {
        if (const auto* method = std::get_if<Method>(&_spec.method))
            return *method == Method::none ? Form::none : Form::gain;
        if (std::holds_alternative<shaders::Directional>(_spec.method)) return Form::gain;
        if (std::holds_alternative<shaders::Balanced>(_spec.method)) return Form::pair_gain;
        return std::holds_alternative<shaders::RandomWalk>(_spec.method) ? Form::replaced
                                                                         : Form::added_lobe;
    }
    std::string family() const override
    {
        return _name.substr(0, _name.rfind("." + std::string(shaders::name(_spec.method))));
    }
    std::unique_ptr<conformance::TestedNormals> normals(const Parameters& p) const override
    {
        if (_spec.lobe != Lobe::conductor || form() != Form::none) return nullptr;
        return with_distribution<double>(
            specified(p), [](const auto& d) -> std::unique_ptr<conformance::TestedNormals> {
                return std::make_unique<Normals<std::decay_t<decltype(d)>>>(d);
            });
    }
    std::vector<conformance::TableError> table_errors(int places) const override
    {
        std::vector<conformance::TableError> errors;
        for (const std::string& table : table_names()) errors.push_back(table_error(table, places));
        return errors;
    }

private:
    std::vector<std::string> table_names() const
    {
        if (form() != Form::gain && form() != Form::pair_gain) return {};
        const std::string distribution(shaders::name(_spec.distribution));
        const bool glass = _spec.lobe == Lobe::dielectric && !_spec.interface.thin_walled;
        std::vector<std::string> names;
        for (const char* quantity : {"E_ss", "E_avg", "falloff", "dip"})
            names.push_back(distribution + "_" + quantity);
        if (form() == Form::pair_gain) names.push_back(distribution + "_balance");
        if (form() == Form::pair_gain || std::holds_alternative<shaders::Directional>(_spec.method))
            for (const char* quantity : {"q_ms", "mu_ms"})
                names.push_back(distribution + "_" + quantity);
        // A mode that only reflects is a mirror's.
        if (!glass || _spec.interface.mode == ScatterMode::R) return names;
        names.clear();
        const bool beta = _spec.interface.shadowing == TransmissionShadowing::beta;
        for (const std::string& table : luts::dielectric_table_names(distribution))
            if ((table.find("_beta_") != std::string::npos) == beta) names.push_back(table);
        return names;
    }

    static bool has_roughness(const shaders::PlainMaterial& material)
    {
        return std::visit(
            [](const auto& s) { return HasRoughness<std::decay_t<decltype(s)>>::value; },
            material.surface);
    }

    ClosureSpec specified(const Parameters& p) const { return specified(_spec, p, p.alpha_x); }

    // White, where it has a colour. `roughness` is that of what has no microfacets: the widths of
    // others may be exchanged.
    static ClosureSpec specified(ClosureSpec spec, const Parameters& p, double roughness)
    {
        using conformance::Reflectance;
        if (spec.combination)
            for (auto* part : {&spec.combination->first, &spec.combination->second})
                *part = std::make_shared<const ClosureSpec>(specified(**part, p, 0.5));
        if (spec.plain)
            std::visit(
                [&](auto& s) {
                    s.color = ColorD(1.0);
                    if constexpr (HasRoughness<std::decay_t<decltype(s)>>::value)
                        s.roughness = roughness;
                },
                spec.plain->surface);
        spec.precision = p.in_double ? Precision::twice : Precision::single;
        spec.alpha_x = p.alpha_x;
        spec.alpha_y = p.alpha_y;
        spec.gamma = p.gamma;
        spec.interface.eta = p.eta;
        if (spec.lobe == Lobe::dielectric)
            spec.fresnel = DielectricParameters{p.eta};
        else if (p.reflectance == Reflectance::schlick)
            spec.fresnel = SchlickParameters{p.F0, p.F82, ColorD(1.0), 5};
        else if (p.reflectance == Reflectance::conductor)
            spec.fresnel = ConductorParameters{p.n, p.k};
        else
            spec.fresnel = ConstantParameters{};
        return spec;
    }

    ClosureSpec _spec;
    std::string _name;
    const Subject *_bare, *_reference;
};

class Collection
{
public:
    Collection()
    {
        for (const DistributionKind distribution : shaders::all_distributions)
        {
            for (const Lobe lobe : {Lobe::conductor, Lobe::generalized_schlick})
            {
                ClosureSpec spec;
                spec.lobe = lobe;
                spec.distribution = distribution;
                add_methods(spec);
            }
            add_interfaces(distribution);
        }
        ClosureSpec sheen;
        sheen.lobe = Lobe::sheen;
        add(sheen, nullptr, nullptr);
        add_plain();
        add_combinations();
    }

    const std::vector<const conformance::Subject*>& all() const { return _all; }

private:
    const conformance::Subject* add(const ClosureSpec& spec, const conformance::Subject* bare,
                                    const conformance::Subject* reference)
    {
        _owned.push_back(std::make_unique<BuiltIn>(spec, bare, reference));
        _all.push_back(_owned.back().get());
        return _all.back();
    }

    // What the library has no combination or no table for is left out.
    void add_methods(ClosureSpec spec)
    {
        spec.method = Method::none;
        const conformance::Subject* bare = add(spec, nullptr, nullptr);
        const bool beta = spec.interface.shadowing == TransmissionShadowing::beta;
        const conformance::Subject* walk = nullptr;
        spec.method = shaders::RandomWalk{};
        if ((spec.lobe != Lobe::dielectric || beta) && exists(spec))
            walk = add(spec, bare, nullptr);
        for (const std::string_view method : shaders::compensation_names())
        {
            spec.method = *shaders::compensation_named(method);
            const auto* gain = std::get_if<Method>(&spec.method);
            const auto* other_walk = std::get_if<shaders::RandomWalk>(&spec.method);
            if ((gain && *gain == Method::none) || (other_walk && !(other_walk->bounded && walk)))
                continue;
            // Of dielectrics these two are one formula, and so are those of Eq. 6.
            if (spec.lobe == Lobe::dielectric &&
                (method == "normalise" || method == "kulla-conty-series"))
                continue;
            if (exists(spec)) add(spec, bare, walk);
        }
    }

    static ClosureSpec plain(Lobe lobe, const shaders::PlainMaterial::Surface& surface)
    {
        ClosureSpec spec;
        spec.lobe = lobe;
        spec.plain = shaders::PlainMaterial{surface};
        return spec;
    }
    static ClosureSpec eon()
    {
        shaders::OrenNayarSurface surface;
        surface.energy_compensation = true;
        return plain(Lobe::oren_nayar_diffuse, surface);
    }

    void add_plain()
    {
        using shaders::ClothMode;
        shaders::ClothSurface cloth;
        add(eon(), nullptr, nullptr);
        add(plain(Lobe::oren_nayar_diffuse, shaders::OrenNayarSurface{}), nullptr, nullptr);
        add(plain(Lobe::burley_diffuse, shaders::BurleyDiffuseSurface{}), nullptr, nullptr);
        add(plain(Lobe::translucent, shaders::TranslucentSurface{}), nullptr, nullptr);
        add(plain(Lobe::transparent, shaders::TransparentSurface{}), nullptr, nullptr);
        for (const ClothMode mode : {ClothMode::conty_kulla, ClothMode::zeltner})
        {
            cloth.mode = mode;
            add(plain(Lobe::sheen, cloth), nullptr, nullptr);
        }
    }

    // Plastic: the coat with the gain of its mode on a white base that loses nothing.
    void add_combinations()
    {
        ClosureSpec coat;
        coat.lobe = Lobe::dielectric;
        coat.fresnel = DielectricParameters{};
        coat.interface.mode = ScatterMode::R;
        coat.method = Method::turquin;
        ClosureSpec plastic;
        plastic.lobe = Lobe::layer;
        plastic.combination =
            Combination{CombinationKind::layer, std::make_shared<const ClosureSpec>(coat),
                        std::make_shared<const ClosureSpec>(eon()), ColorD(1.0)};
        add(plastic, nullptr, nullptr);
    }

    void add_interfaces(DistributionKind distribution)
    {
        ClosureSpec spec;
        spec.lobe = Lobe::dielectric;
        spec.fresnel = DielectricParameters{};
        spec.distribution = distribution;
        for (const auto shadowing :
             {TransmissionShadowing::correlated, TransmissionShadowing::beta})
        {
            spec.interface.shadowing = shadowing;
            add_methods(spec);
        }
        spec.interface.shadowing = TransmissionShadowing::correlated;
        for (const ScatterMode mode : {ScatterMode::R, ScatterMode::T})
        {
            spec.interface.mode = mode;
            add_methods(spec);
        }
        spec.interface.mode = ScatterMode::RT;
        spec.interface.thin_walled = true;
        add_methods(spec);
    }

    static bool exists(const ClosureSpec& spec)
    {
        try
        {
            auto material = spec.material();
            material.bind_tables(has_albedo_tables(spec));
            return true;
        }
        catch (const std::invalid_argument&)
        {
            return false;
        }
        catch (const std::runtime_error& e)
        {
            // A table that ought to be there hides no subject.
            if (!has_albedo_tables(spec)) return false;
            throw BadInput(e.what());
        }
    }

    std::vector<std::unique_ptr<BuiltIn>> _owned;
    std::vector<const conformance::Subject*> _all;
};

}  // namespace

const std::vector<const conformance::Subject*>& built_in_subjects()
{
    static const Collection collection;
    return collection.all();
}

}  // namespace regain::tools
