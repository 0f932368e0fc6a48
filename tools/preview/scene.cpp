// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "scene.h"

#include <embree3/rtcore.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace regain::tools::preview {

using Imath::V3f;

namespace {

constexpr float kOffset = 1e-4f;

/// The triangle's vertices, interpolated; directions are no longer unit.
Vertex blend(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle, float v, float w)
{
    const Vertex &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]],
                 &c = mesh.vertices[triangle[2]];
    const float u = 1.0f - v - w;
    return {a.position * u + b.position * v + c.position * w,
            a.normal * u + b.normal * v + c.normal * w,
            a.tangent * u + b.tangent * v + c.tangent * w};
}

RTCRay to_embree(const Ray& ray)
{
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = 0.0f;
    r.tfar = std::numeric_limits<float>::infinity();
    r.mask = ~0u;
    return r;
}

}  // namespace

Ray Hit::leave(const V3f& direction) const
{
    const float side = direction.dot(geometric_normal) < 0.0f ? -kOffset : kOffset;
    return {position + geometric_normal * side, direction};
}

namespace {

/// The tree is then the same in every run, and with it which of two triangles a ray hits that goes
/// through their common edge. Asking the device for one thread would hold all of oneTBB to one for
/// as long as the device lives.
void commit_by_one_thread(RTCScene scene)
{
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    rtcCommitScene(scene);
}

}  // namespace

struct Scene::Impl
{
    struct Placement
    {
        int mesh;
        V3f offset;
        int material;
        float cosine, sine;  // of the turn

        V3f turned(const V3f& v) const
        {
            return {cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x};
        }
    };

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<RTCScene> mesh_scenes;
    std::vector<Mesh> meshes;
    std::vector<Placement> placements;

    void check(const char* step) const
    {
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE)
            throw std::runtime_error(std::string("Embree failed to ") + step + " (error " +
                                     std::to_string(static_cast<int>(error)) + ")");
    }
    ~Impl()
    {
        for (RTCScene s : mesh_scenes) rtcReleaseScene(s);
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
};

Scene::Scene() : _impl(std::make_unique<Impl>())
{
    _impl->device = rtcNewDevice(nullptr);
    _impl->check("start");
    _impl->scene = rtcNewScene(_impl->device);
    rtcSetSceneFlags(_impl->scene, RTC_SCENE_FLAG_ROBUST);
}

Scene::~Scene() = default;

int Scene::add_mesh(Mesh m)
{
    _impl->meshes.push_back(std::move(m));
    const Mesh& mesh = _impl->meshes.back();

    RTCGeometry geometry = rtcNewGeometry(_impl->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    _impl->check("take a mesh");
    for (const Vertex& v : mesh.vertices)
        for (int k = 0; k < 3; ++k) *vertices++ = v.position[k];
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t index : triangle) *indices++ = index;
    rtcCommitGeometry(geometry);

    RTCScene scene = rtcNewScene(_impl->device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    commit_by_one_thread(scene);
    _impl->mesh_scenes.push_back(scene);
    _impl->check("build a mesh");
    return static_cast<int>(_impl->meshes.size()) - 1;
}

void Scene::place(int mesh, const V3f& offset, int material, float turn)
{
    const float c = std::cos(turn), s = std::sin(turn);
    RTCGeometry instance = rtcNewGeometry(_impl->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, _impl->mesh_scenes.at(static_cast<std::size_t>(mesh)));
    // By columns.
    const float transform[12] = {c, 0, -s, 0, 1, 0, s, 0, c, offset.x, offset.y, offset.z};
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(_impl->scene, instance, static_cast<unsigned>(_impl->placements.size()));
    rtcReleaseGeometry(instance);
    _impl->placements.push_back({mesh, offset, material, c, s});
    _impl->check("place a mesh");
}

void Scene::commit()
{
    commit_by_one_thread(_impl->scene);
    _impl->check("build the scene");
}

bool Scene::intersect(const Ray& ray, Hit* hit) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(_impl->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

    const Impl::Placement& placement = _impl->placements[query.hit.instID[0]];
    const Mesh& mesh = _impl->meshes[static_cast<std::size_t>(placement.mesh)];
    const auto& triangle = mesh.triangles[query.hit.primID];
    Vertex point = blend(mesh, triangle, query.hit.u, query.hit.v);

    hit->material = placement.material;
    hit->in_object = point.position - mesh.centre;
    hit->mapping = mesh.mapping;
    point = {placement.turned(point.position), placement.turned(point.normal),
             placement.turned(point.tangent)};
    // From the corners, not along the ray: the error is that of the mesh's size, not the distance.
    hit->position = point.position + placement.offset;
    V3f ns = point.normal.normalized();
    V3f ng = placement.turned(V3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z)).normalized();
    if (ng.dot(ns) < 0.0f) ng = -ng;

    // Near silhouettes an interpolated normal can face away while its triangle does not.
    const float facing = ng.dot(ray.direction) < 0.0f ? -1.0f : 1.0f;
    const float cosine = facing * ns.dot(ray.direction);
    constexpr float kLeast = 1e-3f;
    if (cosine < kLeast) ns = (ns + ray.direction * (facing * (kLeast - cosine))).normalized();

    const V3f t = point.tangent - ns * ns.dot(point.tangent);
    hit->geometric_normal = ng;
    hit->normal = ns;
    hit->tangent = t.length2() > 1e-8f ? t.normalized() : perpendicular(ns);
    return true;
}

bool Scene::occluded(const Ray& ray) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r = to_embree(ray);
    rtcOccluded1(_impl->scene, &context, &r);
    return r.tfar < 0.0f;
}

}  // namespace regain::tools::preview
