// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// One of two parts of a program, each compiled with a Regain of its own. NAME is the function it
// shows; a mistake in keeping the two apart would have the linker take one's templates for both.

#include <regain/closures/compensated.h>
#include <regain/closures/conductor.h>
#include <regain/renderman/closure_bxdf.h>

#include <typeinfo>

extern "C" const char* NAME(float alpha, float* albedo)
{
    using namespace regain;
    const Conductor<float> lobe(GGX<float>(alpha),
                                ConductorFresnel<float>(Color3<float>(0.2f), Color3<float>(3.0f)));
    *albedo = lobe.albedo(Vec3<float>(0.6f, 0.0f, 0.8f)).reflect.x;
    return typeid(Conductor<float>).name();
}
