// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

/// @file
/// The memory that a batched host lends to its plug-ins.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace regain::tools::preview {

/// Bump allocator of one thread: grows by blocks and keeps them when it is reset. Runs no
/// destructors.
class Arena
{
public:
    void* allocate(std::size_t bytes, std::size_t align)
    {
        for (;; ++_block, _used = 0)
        {
            if (_block == _blocks.size())
                _blocks.push_back(Block(bytes + align > kBlock ? bytes + align : kBlock));
            Block& block = _blocks[_block];
            const auto base = reinterpret_cast<std::uintptr_t>(block.memory.get());
            const std::size_t start = (base + _used + align - 1) / align * align - base;
            if (start + bytes > block.size) continue;
            _used = start + bytes;
            return block.memory.get() + start;
        }
    }
    void reset() { _block = _used = 0; }

    /// For renderman::ShadingContext::allocFn. Null when memory is out, as hosts answer.
    static void* allocate_from(void* arena, std::size_t bytes, std::size_t align) noexcept
    {
        try
        {
            return static_cast<Arena*>(arena)->allocate(bytes, align);
        }
        catch (const std::bad_alloc&)
        {
            return nullptr;
        }
    }

private:
    static constexpr std::size_t kBlock = 256 * 1024;
    struct Block
    {
        explicit Block(std::size_t n) : memory(new std::byte[n]), size(n) {}
        std::unique_ptr<std::byte[]> memory;
        std::size_t size;
    };

    std::vector<Block> _blocks;
    std::size_t _block = 0, _used = 0;
};

}  // namespace regain::tools::preview
