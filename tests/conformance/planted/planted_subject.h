// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// A subject of the kit that is put together of its parts.

#pragma once

#include <regain/conformance/adapt.h>
#include <regain/conformance/subject.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace regain::planted {

using conformance::Color;
using conformance::Direction;
using conformance::Form;
using conformance::Parameters;
using conformance::Promises;
using conformance::Reads;
using conformance::Subject;
using conformance::TestedClosure;
using conformance::TestedNormals;

/// What albedo() of these closures is good to: the mean of a thousand samples.
constexpr double albedo_error = 1.5e-2;

/// No direction.
template <class Real>
Sample<Real> nothing()
{
    Sample<Real> s;
    s.wi = Vec3<Real>(0, 0, 1);
    s.weight = Color3<Real>(0);
    s.pdf = 0;
    return s;
}

struct Planted final : Subject
{
    using Make = std::function<std::unique_ptr<TestedClosure>(const Parameters&)>;

    std::string id;
    Reads what_is_read;
    Make maker;
    std::function<Promises(const Parameters&, const Direction&)> promiser;
    std::function<std::unique_ptr<TestedNormals>(const Parameters&)> normals_maker;
    std::function<std::vector<conformance::TableError>(int)> table_reader;
    Form kind = Form::none;
    std::shared_ptr<const Subject> without_gain, compared_with;

    std::string name() const override { return id; }
    Reads reads() const override { return what_is_read; }
    std::unique_ptr<TestedClosure> make(const Parameters& p) const override { return maker(p); }
    Promises promises(const Parameters& p, const Direction& wo) const override
    {
        return promiser ? promiser(p, wo) : Promises{};
    }
    Form form() const override { return kind; }
    const Subject* bare() const override { return without_gain.get(); }
    const Subject* reference() const override { return compared_with.get(); }
    std::unique_ptr<TestedNormals> normals(const Parameters& p) const override
    {
        return normals_maker ? normals_maker(p) : nullptr;
    }
    std::vector<conformance::TableError> table_errors(int places) const override
    {
        return table_reader ? table_reader(places) : std::vector<conformance::TableError>{};
    }
};

using PlantedSubject = std::shared_ptr<Planted>;

inline PlantedSubject new_subject(const std::string& name, const Reads& reads, Planted::Make maker)
{
    auto subject = std::make_shared<Planted>();
    subject->id = name;
    subject->what_is_read = reads;
    subject->maker = std::move(maker);
    return subject;
}

}  // namespace regain::planted
