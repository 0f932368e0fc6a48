// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "subjects.h"

#include <cuda_runtime.h>

namespace regain::tests {

std::string why_no_gpu()
{
    int count = 0;
    const cudaError_t error = cudaGetDeviceCount(&count);
    if (error != cudaSuccess) return cudaGetErrorString(error);
    return count > 0 ? "" : "no CUDA device";
}

}  // namespace regain::tests
