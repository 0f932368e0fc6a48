// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Calls something of every part that is linked; WITH_part says which are.

#include <regain/closures/compensated.h>
#include <regain/closures/conductor.h>

#ifdef WITH_luts
#include <regain/luts/builtin.h>
#endif
#ifdef WITH_shaders
#include <regain/shaders/metals.h>
#endif
#ifdef WITH_renderman
#include <regain/renderman/host.h>
#endif
#ifdef WITH_clarisse
#include <regain/clarisse/host.h>
#endif

#ifdef WITH_conformance
#include <regain/closures/diffuse.h>
#include <regain/conformance/adapt.h>
#include <regain/conformance/run.h>
#endif

#include <cmath>
#include <iostream>

int main()
{
    using namespace regain;
    std::cout << "Regain " << REGAIN_VERSION_STRING << '\n';

    // A rough mirror loses light; with tables bound, a method gives it back.
    const ConductorFresnel<float> mirror(Color3<float>(0.0f), Color3<float>(1.0f));
    const Conductor<float> lobe(GGX<float>(0.8f), mirror);
    const Vec3<float> wo(0.6f, 0.0f, 0.8f);
    MicrofacetTables tables;
#ifdef WITH_luts
    tables = luts::ggx_tables();
#endif
    const float lossy = lobe.albedo(wo).reflect.x;
    const float kept = compensated(lobe, Method::turquin, tables).albedo(wo).reflect.x;
    std::cout << "albedo " << lossy << ", compensated " << kept << '\n';
    bool good = lossy > 0.2f && lossy < 0.95f;
#ifdef WITH_luts
    good = good && std::abs(kept - 1.0f) < 5e-3f;
#else
    // Without a table the gain is 1.
    good = good && std::abs(kept - lossy) < 1e-6f;
#endif

#ifdef WITH_shaders
    std::cout << shaders::metal_names().size() << " metals\n";
    good = good && !shaders::metal_names().empty();
#endif
#ifdef WITH_renderman
    good = good && !renderman::LobeSet().any();
#endif
#ifdef WITH_clarisse
    good = good && clarisse::lobe_label().category() == clarisse::diffuse_reflection;
#endif

#ifdef WITH_conformance
    const auto tested = conformance::adapt(Diffuse<float>(Color3<float>(0.5f)));
    tested->prepare(conformance::Direction(0, 0, 1));
    std::cout << conformance::all_checks().size() << " checks\n";
    good = good && tested->pdf(conformance::Direction(0, 0, 1)) > 0.3 &&
           !conformance::all_checks().empty();
#endif

    return good ? 0 : 1;
}
