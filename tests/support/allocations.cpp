// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> count{0};

}  // namespace

long regain::tests::allocations() { return count; }

void* operator new(std::size_t n)
{
    ++count;
    if (void* p = std::malloc(n ? n : 1)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
