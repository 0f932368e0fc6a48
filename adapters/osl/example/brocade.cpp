// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Brocade as a shader: threads of metal, their highlights drawn out along the tangent, woven into a
// cloth of velvet, a nap on it all. What it would read in OSL:
//
//   Ci = layer(nap * sheen_bsdf(N, nap_color, nap_roughness),
//              mix(oren_nayar_diffuse_bsdf(N, cloth_color, 0.8, "energy_compensation", 1),
//                  generalized_schlick_bsdf(N, dPdu, 1, 0, ax, ay, thread_color, 1, 5, "ggx"),
//                  threads));

#include <regain/osl/plugin.h>

#include <cmath>
#include <new>

namespace {

using namespace regain;
using Imath::C3f;
using osl::ClosureColor;

struct Brocade
{
    C3f cloth_color, thread_color, nap_color;
    float threads, thread_roughness, thread_stretch, nap, nap_roughness;

    const ClosureColor* shade(const osl::ShaderGlobals& sg, osl::NodePool& pool) const
    {
        osl::OrenNayarDiffuseParams cloth;
        cloth.N = sg.N;
        cloth.albedo = cloth_color;
        cloth.roughness = 0.8f;
        cloth.energy_compensation = 1;

        osl::GeneralizedSchlickParams thread;
        const float alpha = thread_roughness * thread_roughness, aspect = std::sqrt(thread_stretch);
        thread.N = sg.N;
        thread.U = sg.dPdu;
        thread.f0 = thread_color;
        thread.roughness_x = std::fmin(alpha * aspect, 1.0f);
        thread.roughness_y = alpha / aspect;

        osl::SheenParams fuzz;
        fuzz.N = sg.N;
        fuzz.albedo = nap_color;
        fuzz.roughness = nap_roughness;
        fuzz.mode = 1;

        const auto* base = pool.add(
            pool.multiply(C3f(1 - threads), pool.component(osl::oren_nayar_diffuse_id, cloth)),
            pool.multiply(C3f(threads), pool.component(osl::generalized_schlick_id, thread)));
        const auto* top = pool.multiply(C3f(nap), pool.component(osl::sheen_id, fuzz));
        return pool.component(osl::layer_id, osl::LayerParams{top, base});
    }
};

constexpr ParameterInfo parameters[] = {
    {"cloth_color", 3, {0.3f, 0.02f, 0.06f}, 0, 1, "of what the threads are woven into"},
    {"thread_color", 3, {0.95f, 0.75f, 0.4f}, 0, 1, "of metal along its normal"},
    {"threads", 1, {0.5f}, 0, 1, "how much of it is threads"},
    {"thread_roughness", 1, {0.5f}, 0, 1, "the root of alpha"},
    {"thread_stretch", 1, {4}, 1, 20, "width along the tangent over that across"},
    {"nap", 1, {0.5f}, 0, 1, "how much fuzz there is"},
    {"nap_color", 3, {0.9f, 0.85f, 0.8f}, 0, 1, "of the fuzz"},
    {"nap_roughness", 1, {0.4f}, 0, 1, "of the fuzz"}};

void* create_shader(const ParameterValue* v, const char** error)
{
    const auto color = [](const ParameterValue& p) { return C3f(p.v[0], p.v[1], p.v[2]); };
    auto* made = new (std::nothrow) Brocade{color(v[0]), color(v[1]), color(v[6]), v[2].v[0],
                                            v[3].v[0],   v[4].v[0],   v[5].v[0],   v[7].v[0]};
    if (!made) *error = "out of memory";
    return made;
}

}  // namespace

extern "C" REGAIN_PLUGIN_EXPORT const regain::osl::ShaderPlugin* regain_shader_plugin()
{
    static constexpr osl::ShaderPlugin plugin{
        osl::ShaderPlugin::current,
        REGAIN_VERSION_STRING,
        "brocade",
        parameters,
        sizeof(parameters) / sizeof(*parameters),
        &create_shader,
        [](void* shader) { delete static_cast<Brocade*>(shader); },
        [](const void* shader, const osl::ShaderGlobals& sg, osl::NodePool& pool) {
            return static_cast<const Brocade*>(shader)->shade(sg, pool);
        }};
    return &plugin;
}
