// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Test doubles: a Lambert material of each host shape, written against the interface alone, and a
/// small world to put them in.

#pragma once

#include "preview/grid_integrator.h"
#include "preview/point_integrator.h"
#include "preview/render_job.h"
#include "preview/widget.h"

#include <cmath>
#include <memory>
#include <new>
#include <vector>

namespace regain::tools::preview::doubles {

using Imath::C3f;
using Imath::V2f;
using Imath::V3f;

constexpr float kInvPi = 0.318309886f;

/// Cosine-distributed direction about +z; its pdf is z / pi.
inline V3f cosine_direction(float u, float v)
{
    const float r = std::sqrt(u), phi = 2.0f * static_cast<float>(M_PI) * v;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0f - u)};
}

class GridLambert final : public renderman::Factory
{
public:
    explicit GridLambert(const C3f& albedo) : _albedo(albedo) {}

    renderman::Bxdf* beginScatter(const renderman::ShadingContext* ctx, const renderman::LobeSet&,
                                  renderman::ShadeMode, void*, void*) override
    {
        auto* memory = ctx->alloc<Bxdf>();
        return memory ? new (memory) Bxdf(ctx, this, _albedo) : nullptr;
    }

private:
    class Bxdf final : public renderman::Bxdf
    {
    public:
        Bxdf(const renderman::ShadingContext* c, renderman::Factory* f, const C3f& albedo)
            : renderman::Bxdf(c, f), _albedo(albedo)
        {}
        renderman::Domain evaluateDomain() const override { return renderman::kOutsideReflect; }
        renderman::LobeSet aggregateLobes() const override { return renderman::LobeSet(lobe()); }

        void generateSample(renderman::Transport, const renderman::LobeSet* wanted,
                            renderman::Rng* rng, renderman::Lobe* sampled, V3f* Ln,
                            renderman::LobeWeights& weights, float* fwd, float* rev, C3f*) override
        {
            auto* xi = ctx->alloc<V2f>(static_cast<std::size_t>(ctx->numPts));
            rng->draw2D(xi);
            C3f* out = weights.addActiveLobe(lobe());
            for (int i = 0; i < ctx->numPts; ++i)
            {
                const V3f n = ctx->Nn[i], t = ctx->Tn[i], d = cosine_direction(xi[i].x, xi[i].y);
                Ln[i] = t * d.x + n.cross(t) * d.y + n * d.z;
                sampled[i] = lobe();
                sampled[i].valid = wanted[i].has(lobe()) && answer(i, Ln[i], out, fwd, rev);
            }
        }
        void evaluateSample(renderman::Transport, const renderman::LobeSet* wanted, renderman::Rng*,
                            renderman::LobeSet* evaluated, const V3f* Ln,
                            renderman::LobeWeights& weights, float* fwd, float* rev) override
        {
            C3f* out = weights.addActiveLobe(lobe());
            for (int i = 0; i < ctx->numPts; ++i)
            {
                evaluated[i].clear();
                set(i, 0, 0, fwd, rev);
                if (wanted[i].has(lobe()) && answer(i, Ln[i], out, fwd, rev))
                    evaluated[i] = renderman::LobeSet(lobe());
            }
        }
        void evaluateSamplesAtIndex(renderman::Transport, const renderman::LobeSet&,
                                    renderman::Rng*, int, int, renderman::LobeSet*, const V3f*,
                                    renderman::LobeWeights&, float*, float*) override
        {}

    private:
        static renderman::Lobe lobe() { return {renderman::LobeClass::Diffuse, 0, true, false}; }
        // The way back may not be asked for.
        static void set(int i, float forward, float back, float* fwd, float* rev)
        {
            fwd[i] = forward;
            if (rev) rev[i] = back;
        }
        bool answer(int i, const V3f& L, C3f* out, float* fwd, float* rev) const
        {
            const float cosine = ctx->Nn[i].dot(L);
            set(i, 0, 0, fwd, rev);
            if (cosine <= 0.0f || ctx->Ngn[i].dot(L) <= 0.0f || ctx->Nn[i].dot(ctx->Vn[i]) <= 0.0f)
                return false;
            set(i, cosine * kInvPi, ctx->Nn[i].dot(ctx->Vn[i]) * kInvPi, fwd, rev);
            out[i] = _albedo * fwd[i];
            return true;
        }
        C3f _albedo;
    };

    C3f _albedo;
};

class PointLambert final : public clarisse::bxdf_lobe<float>
{
public:
    explicit PointLambert(const C3f& albedo) : _albedo(albedo) {}

    clarisse::lobe_label label() const override { return {}; }
    float roughness() const override { return 1.0f; }
    float sample(const V3f& wi, float u, float v, float, V3f& wo, C3f& weight,
                 float* reverse) const override
    {
        wo = cosine_direction(u, v);
        return evaluate(wi, wo, weight, reverse);
    }
    float evaluate(const V3f& wi, const V3f& wo, C3f& weight, float* reverse) const override
    {
        weight = C3f(0.0f);
        if (reverse) *reverse = 0.0f;
        if (wi.z <= 0.0f || wo.z <= 0.0f) return 0.0f;
        weight = _albedo;
        if (reverse) *reverse = wi.z * kInvPi;
        return wo.z * kInvPi;
    }
    C3f albedo(const V3f&) const override { return _albedo; }

    /// The material object is the albedo. `lobes` equal lobes share it, so that the host has
    /// something to mix.
    template <int lobes>
    static clarisse::material_callbacks<float> callbacks()
    {
        clarisse::material_callbacks<float> c;
        c.create_module_data = [](const void* object) -> void* {
            return new C3f(*static_cast<const C3f*>(object));
        };
        c.destroy_module_data = [](const void*, void* data) { delete static_cast<C3f*>(data); };
        c.create_lobes = [](const void* data, const clarisse::shading_point<float>& p,
                            clarisse::scratchpad& pad, clarisse::lobe_list<float>& list) {
            for (int k = 0; k < lobes; ++k)
            {
                clarisse::lobe_entry<float> e;
                e.lobe = pad.make<PointLambert>(*static_cast<const C3f*>(data));
                e.weight = C3f(static_cast<float>(k + 1) * 2.0f / (lobes * (lobes + 1)));
                e.x = p.tangent;
                e.z = p.ns;
                e.y = e.z.cross(e.x);
                if (!e.lobe || !list.add(e)) return false;
            }
            return true;
        };
        return c;
    }

private:
    C3f _albedo;
};

inline LatLongImage constant_image(float value)
{
    LatLongImage image;
    image.width = 8;
    image.height = 4;
    image.pixels.assign(32, C3f(value));
    return image;
}

/// A unit sphere alone (material 0) in front of the camera.
struct SphereWorld
{
    SphereWorld(LatLongImage light, int size)
        : environment(std::move(light)), world{scene, environment, camera, size, size}
    {
        Mesh sphere;
        add_sphere(sphere, V3f(0.0f), 1.0f, 256);
        scene.place(scene.add_mesh(std::move(sphere)), V3f(0.0f), 0);
        scene.commit();
    }
    Scene scene;
    Environment environment;
    Camera camera{V3f(0, 0, 10), V3f(0.0f), 1.1f, 1.1f};
    World world;
};

/// One widget (material 1) on a floor (material 0).
struct WidgetWorld
{
    WidgetWorld(LatLongImage light, int width, int height)
        : environment(std::move(light)),
          camera(frame_row(1, 2.5f, kWidgetHeight, float(width) / float(height))),
          world{scene, environment, camera, width, height}
    {
        const int floor = scene.add_mesh(make_floor(50.0f));
        const int widget = scene.add_mesh(make_widget());
        scene.place(floor, V3f(0.0f), 0);
        scene.place(widget, V3f(0.0f), 1);
        scene.commit();
    }

    Scene scene;
    Environment environment;
    Camera camera;
    World world;
};

/// Two Lambert materials, for either host.
struct TwoLamberts
{
    TwoLamberts(const C3f& floor, const C3f& body)
        : albedos{floor, body}, factories{GridLambert(floor), GridLambert(body)}
    {}
    std::unique_ptr<Integrator> grid(const World& world)
    {
        return std::make_unique<GridIntegrator>(
            world, std::vector<GridMaterial>{{&factories[0], nullptr}, {&factories[1], nullptr}});
    }
    std::unique_ptr<Integrator> point(const World& world)
    {
        return std::make_unique<PointIntegrator>(
            world,
            std::vector<PointMaterial>{{&callbacks, &albedos[0]}, {&callbacks, &albedos[1]}});
    }

    C3f albedos[2];
    GridLambert factories[2];
    clarisse::material_callbacks<float> callbacks = PointLambert::callbacks<3>();
};

inline C3f mean(const Film& film)
{
    Imath::Vec3<double> sum(0.0);
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
        {
            const C3f c = film.mean(x, y);
            sum += Imath::Vec3<double>(c.x, c.y, c.z);
        }
    sum /= static_cast<double>(film.width()) * film.height();
    return {static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)};
}

}  // namespace regain::tools::preview::doubles
