// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A host's own file: compiled without exceptions and without type information.

#include <regain/closures/conductor.h>
#include <regain/closures/layer.h>
#include <regain/closures/oren_nayar_diffuse.h>
#include <regain/renderman/closure_bxdf.h>

namespace {

struct Material
{
    template <class Real>
    auto closure(Real) const
    {
        using Color = regain::Color3<Real>;
        const regain::Conductor<Real> top(
            regain::GGX<Real>(Real(0.3f)),
            regain::ConductorFresnel<Real>(Color(Real(0.2f)), Color(Real(3))));
        return regain::layer(top, regain::OrenNayarDiffuse<Real>(Color(Real(0.5f))));
    }
    const char* lobe_name() const { return "metal"; }
};

}  // namespace

regain::renderman::Factory& strict_factory()
{
    static regain::renderman::ClosureFactory<Material> factory;
    return factory;
}
