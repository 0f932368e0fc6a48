// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// Copies in a GPU's memory that last as long as this object, those of tables among them: what a
/// renderer does once for each table that its materials read.

#pragma once

#include "question.h"

#include <cuda_runtime.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace regain::tests {

class GpuMemory
{
public:
    GpuMemory() = default;
    GpuMemory(const GpuMemory&) = delete;
    GpuMemory& operator=(const GpuMemory&) = delete;
    ~GpuMemory()
    {
        for (void* p : _copies) cudaFree(p);
    }

    static void check(cudaError_t error)
    {
        if (error != cudaSuccess)
            throw std::runtime_error(std::string("CUDA: ") + cudaGetErrorString(error));
    }

    template <class T>
    T* copy(const T* data, std::size_t count)
    {
        void* there = nullptr;
        check(cudaMalloc(&there, count * sizeof(T)));
        _copies.push_back(there);
        check(cudaMemcpy(there, data, count * sizeof(T), cudaMemcpyHostToDevice));
        return static_cast<T*>(there);
    }

    Surface copy(Surface s)
    {
        s.mirror = copy(s.mirror);
        for (DielectricTables& tables : s.glass) tables = copy(tables);
        return s;
    }

private:
    TableView copy(TableView table)
    {
        if (table)
            table.data = copy(table.data, std::size_t(table.width) *
                                              std::size_t(table.height > 0 ? table.height : 1) *
                                              std::size_t(table.depth));
        return table;
    }
    template <int Axes>
    GridView<Axes> copy(GridView<Axes> table)
    {
        std::size_t count = 1;
        for (int nodes : table.size) count *= std::size_t(nodes);
        if (table) table.data = copy(table.data, count);
        return table;
    }
    // A view that is pointed to goes there as well.
    const GridView<5>* copy(const GridView<5>* table)
    {
        if (!table) return nullptr;
        const GridView<5> there = copy(*table);
        return copy(&there, 1);
    }

    MicrofacetTables copy(MicrofacetTables t)
    {
        for (TableView* table : {&t.E_ss, &t.E_avg, &t.falloff, &t.dip, &t.balance, &t.q_ms,
                                 &t.mu_ms, &t.spread, &t.forward, &t.tilt})
            *table = copy(*table);
        if (t.fits) t.fits = copy(t.fits, 1);
        t.anisotropy = copy(t.anisotropy);
        t.balance_anisotropy = copy(t.balance_anisotropy);
        return t;
    }
    DielectricTables copy(DielectricTables t)
    {
        for (int side = 0; side < 2; ++side)
            for (TableView* table : {&t.E[side], &t.R[side], &t.later[side]}) *table = copy(*table);
        if (t.anisotropy)
        {
            DielectricAnisotropy there = *t.anisotropy;
            for (auto& change : there.change) change = copy(change);
            t.anisotropy = copy(&there, 1);
        }
        return t;
    }

    std::vector<void*> _copies;
};

}  // namespace regain::tests
