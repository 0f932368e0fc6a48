// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "lobe_maker.h"

namespace regain::tools::preview {

namespace {

struct WithPlain
{
    template <class Visit>
    static decltype(auto) call(const LobeMaker::Material& material, float strength,
                               const Visit& visit)
    {
        return std::get<shaders::PlainMaterial>(material).with_closure(strength, visit);
    }
};

}  // namespace

const LobeMaker plain_lobes = MakesLobes<WithPlain>::maker;

}  // namespace regain::tools::preview
