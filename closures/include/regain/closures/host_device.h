// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// What stands before every function that may run on a GPU: CUDA and HIP compilers have to be told,
/// to all others it is nothing.

#pragma once

#if defined(__CUDACC__) || defined(__HIPCC__)
#define REGAIN_HOST_DEVICE __host__ __device__
#else
#define REGAIN_HOST_DEVICE
#endif
