#version 330
#extension GL_GOOGLE_include_directive : require
// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A shader that compensates a lobe by the exported formulas.

#include "regain_fits.glsl"

in vec2 at;
out vec4 color;

void main()
{
    float E = regain_ggx_E_ss(at.x, at.y) * regain_beckmann_E_ss(at.x, at.y);
    float average = regain_ggx_E_avg(at.y) * regain_beckmann_E_avg(at.y);
    float q = regain_ggx_q_ms(at.x, at.y) * regain_beckmann_q_ms(at.x, at.y);
    float mu = regain_ggx_mu_ms(at.x, at.y) * regain_beckmann_mu_ms(at.x, at.y);
    color = vec4((1.0 - E) / E, average, q, mu);
}
