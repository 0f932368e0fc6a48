// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "subject.h"

#include "../errors.h"
#include "../table_bytes.h"
#include "subject_model.h"

#include <regain/shaders/tables_read.h>

#include <stdexcept>

namespace regain::tools::cost {
namespace {

const SubjectMaker& maker(shaders::DistributionKind distribution)
{
    using shaders::DistributionKind;
    switch (distribution)
    {
        case DistributionKind::beckmann: return beckmann_subjects;
        case DistributionKind::gtr: return gtr_subjects;
        case DistributionKind::std: return std_subjects;
        case DistributionKind::ggx: break;
    }
    return ggx_subjects;
}

void bind(shaders::MicrofacetMaterial& material, bool for_albedo)
{
    try
    {
        material.bind_tables(for_albedo);
    }
    // No such combination, or no such table.
    catch (const std::logic_error& e)
    {
        throw BadInput(e.what());
    }
    catch (const std::runtime_error& e)
    {
        throw BadInput(e.what());
    }
}

}  // namespace

Bound make_subject(Surface surface)
{
    // A layer asks the coat for its albedo.
    bind(surface.material, surface.base.has_value());
    Bound bound;
    bound.subject = maker(surface.material.distribution).surface(surface);
    const auto& m = surface.material;
    bound.table_bytes =
        bytes_of(shaders::tables_read(m.method, m.tables())) + bytes_of(m.interface_tables());
    return bound;
}

std::unique_ptr<Subject> make_reference(Surface surface)
{
    const SubjectMaker& make = maker(surface.material.distribution);
    if (surface.base) return make.coat(surface.material);
    surface.material.method = shaders::RandomWalk{};
    bind(surface.material, false);
    return make.surface(surface);
}

}  // namespace regain::tools::cost
