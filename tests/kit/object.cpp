// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A shared object for the kit: two Lambertian closures, "lambert" and "lambert2", with a CHANGE to
// their array `s` or to how many are `shown`.

#include <regain/conformance/c_closure.h>

#include <cmath>
#include <limits>

namespace {

constexpr double pi = 3.14159265358979324, albedo_of_it = 0.5;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
[[maybe_unused]] const char bad_name[] = "a name; with more";

// Unlike <, these raise no floating-point exception where a number is NaN.
bool usable(const double w[3])
{
    for (int k = 0; k < 3; ++k)
        if (!std::isless(std::abs(w[k]), 1.1)) return false;
    return std::abs(w[0] * w[0] + w[1] * w[1] + w[2] * w[2] - 1) < 1e-5 && w[2] > 0;
}
double in_unit(double x) { return std::isless(0, x) ? (std::isless(x, 1) ? x : 1) : 0; }

// The closure has no state, but each is another object, and is destroyed as such.
void* create(const regain_parameters_v1*) { return new double(albedo_of_it); }
void destroy(void* closure) { delete static_cast<double*>(closure); }
void traits(const void*, regain_traits_v1* out)
{
    out->reciprocal = out->exact_pdf = 1;
    out->random_numbers = 2;
}
void eval(const void* closure, const double wo[3], const double wi[3], const double*, double f[3])
{
    const double value =
        usable(wo) && usable(wi) ? *static_cast<const double*>(closure) * wi[2] / pi : 0;
    f[0] = f[1] = f[2] = value;
}
double pdf(const void*, const double wo[3], const double wi[3])
{
    return usable(wo) && usable(wi) ? wi[2] / pi : 0;
}
void sample(const void* closure, const double wo[3], const double u[3], regain_sample_v1* out)
{
    out->wi[2] = 1;
    if (!usable(wo)) return;
    const double x = in_unit(u[0]), y = in_unit(u[1]);
    const double r = std::sqrt(1 - x);
    const double wi[3] = {r * std::cos(2 * pi * y), r * std::sin(2 * pi * y), std::sqrt(x)};
    if (!usable(wi)) return;
    out->valid = 1;
    for (int k = 0; k < 3; ++k)
    {
        out->wi[k] = wi[k];
        out->weight[k] = *static_cast<const double*>(closure);
    }
    out->pdf = pdf(closure, wo, wi);
}
void albedo(const void* closure, const double wo[3], regain_albedo_v1* out)
{
    for (double& x : out->reflect) x = usable(wo) ? *static_cast<const double*>(closure) : 0;
    for (double& x : out->transmit) x = 0;
}

// What a CHANGE may put in place of these.
[[maybe_unused]] void* no_closure(const regain_parameters_v1*) { return nullptr; }
[[maybe_unused]] double wrong_pdf(const void* closure, const double wo[3], const double wi[3])
{
    return 1.1 * pdf(closure, wo, wi);
}
[[maybe_unused]] void sample_nan(const void*, const double*, const double*, regain_sample_v1* out)
{
    out->valid = 1;
    out->wi[0] = out->weight[1] = out->pdf = nan;
}
[[maybe_unused]] void weight_by_alpha(const regain_parameters_v1* p, const double*,
                                      regain_promises_v1* out)
{
    out->weight = p->alpha_x;
    out->surplus = nan;
    out->single = 2e-3;
    out->albedo_noise = 1e-2;
    out->pdf = 3e-3;
}

regain_subject_v1 lambert(const char* name)
{
    regain_subject_v1 s = {};
    s.version = REGAIN_CONFORMANCE_C_VERSION;
    s.size = sizeof s;
    s.name = name;
    s.reads.in_double = 1;
    s.promises = {0, nan, 1e-6, nan, albedo_of_it, 0, 0, 0};
    s.create = create;
    s.destroy = destroy;
    s.traits = traits;
    s.eval = eval;
    s.pdf = pdf;
    s.sample = sample;
    s.albedo = albedo;
    return s;
}

regain_subject_v1 s[] = {lambert("lambert"), lambert("lambert2")};
int shown = 2;

}  // namespace

const regain_subject_v1* regain_conformance_subject(int index)
{
    [[maybe_unused]] static const bool changed = ((void)(CHANGE), true);
    if (index >= shown) return nullptr;
    if (index < 2) return &s[index];
    // More than there are: of another name each.
    static char names[2000][8];
    static regain_subject_v1 more[2000];
    char* name = names[index % 2000];
    for (int i = 0, n = index; i < 7; ++i, n /= 10) name[i] = static_cast<char>('0' + n % 10);
    more[index % 2000] = lambert(name);
    return &more[index % 2000];
}
