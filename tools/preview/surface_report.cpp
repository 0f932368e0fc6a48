// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "surface_report.h"

#include <algorithm>

namespace regain::tools::preview {

using Imath::C3f;
using shaders::ClosureTree;

const std::vector<std::string>& lobe_names()
{
    static const std::vector<std::string> names{
        "metal", "glass", "coat", "diffuse", "sheen", "subsurface", "translucent", "transparent"};
    return names;
}

namespace {

int index_of_lobe(const char* name)
{
    const auto& all = lobe_names();
    const auto found = std::find(all.begin(), all.end(), name);
    return found == all.end() ? 0 : static_cast<int>(found - all.begin()) + 1;
}

int index_of_method(const ClosureTree::Material& material)
{
    const auto* m = std::get_if<shaders::MicrofacetMaterial>(&material);
    if (!m) return 0;
    const auto& all = shaders::compensation_names();
    const auto found = std::find(all.begin(), all.end(), shaders::name(m->method));
    return found == all.end() ? 0 : static_cast<int>(found - all.begin()) + 1;
}

float sum(const C3f& c) { return c.x + c.y + c.z; }

}  // namespace

SurfaceReport report_of(int lobes, const SeenPoint& seen,
                        const std::function<ClosureTree::Material(int)>& material,
                        const std::function<const char*(int)>& name,
                        const std::function<void(const C3f*, C3f*)>& weigh)
{
    SurfaceReport report;
    C3f whole[2];
    for (const bool compensated : {false, true})
    {
        C3f albedo[ClosureTree::most_lobes], weight[ClosureTree::most_lobes];
        for (int k = 0; k < lobes; ++k)
        {
            const auto m = material(k);
            albedo[k] = maker_of(m).albedo(m, compensated ? 1.0f : 0.0f, seen);
        }
        weigh(albedo, weight);
        whole[compensated] = C3f(0.0f);
        float most = -1;
        for (int k = 0; k < lobes; ++k)
        {
            const C3f share = weight[k] * albedo[k];
            whole[compensated] += share;
            if (!compensated || sum(share) <= most) continue;
            most = sum(share);
            report.lobe = index_of_lobe(name(k));
            report.method = index_of_method(material(k));
        }
    }
    report.albedo = whole[true];
    for (int c = 0; c < 3; ++c)
        report.gain[c] = whole[false][c] > 0 ? whole[true][c] / whole[false][c] : 1.0f;
    return report;
}

}  // namespace regain::tools::preview
