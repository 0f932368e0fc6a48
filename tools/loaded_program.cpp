// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "loaded_program.h"

#include "job_description.h"

#include <regain/shaders/wide_material.h>

#include <fmt/format.h>
#include <link.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace regain::tools {

namespace {

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

// The note that holds the identifier; empty of a library that was linked without.
std::string_view build_identifier(const dl_phdr_info& object)
{
    for (int i = 0; i < object.dlpi_phnum; ++i)
    {
        const auto& header = object.dlpi_phdr[i];
        if (header.p_type != PT_NOTE) continue;
        const char* at = reinterpret_cast<const char*>(object.dlpi_addr + header.p_vaddr);
        const char* const end = at + header.p_memsz;
        while (end - at >= static_cast<std::ptrdiff_t>(sizeof(ElfW(Nhdr))))
        {
            ElfW(Nhdr) note;
            std::memcpy(&note, at, sizeof note);
            const char* const name = at + sizeof note;
            const char* const value = name + padded(note.n_namesz);
            at = value + padded(note.n_descsz);
            if (at > end) break;
            if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 &&
                std::memcmp(name, "GNU", 4) == 0)
                return {value, note.n_descsz};
        }
    }
    return {};
}

int add_identifier(dl_phdr_info* object, std::size_t, void* all)
{
    const std::string file = object->dlpi_name;
    const std::string name = file.substr(file.rfind('/') + 1);
    // The kernel's own: machines of one farm may have different kernels.
    if (name.rfind("linux-vdso", 0) == 0 || name.rfind("linux-gate", 0) == 0) return 0;
    static_cast<std::vector<std::string>*>(all)->push_back(name + '\0' +
                                                           std::string(build_identifier(*object)));
    return 0;
}

}  // namespace

std::string loaded_program()
{
    std::vector<std::string> all;
    ::dl_iterate_phdr(&add_identifier, &all);
    // In what order they were loaded makes no difference.
    std::sort(all.begin(), all.end());
    std::uint64_t sum = hash({});
    for (const std::string& one : all) sum = hash(one, sum);
    return fmt::format("{:016x}", sum);
}

std::string instruction_set()
{
    std::string all(shaders::name(shaders::preferred_instruction_set()));
    utsname system = {};
    ::uname(&system);
    all += fmt::format("; {}", system.machine);
#if defined(__x86_64__) || defined(__i386__)
    // The names have to be literals.
    if (__builtin_cpu_supports("sse4.2")) all += " sse4.2";
    if (__builtin_cpu_supports("avx")) all += " avx";
    if (__builtin_cpu_supports("avx2")) all += " avx2";
    if (__builtin_cpu_supports("fma")) all += " fma";
    if (__builtin_cpu_supports("fma4")) all += " fma4";
    if (__builtin_cpu_supports("avx512f")) all += " avx512f";
    if (__builtin_cpu_supports("avx512bw")) all += " avx512bw";
    if (__builtin_cpu_supports("avx512vl")) all += " avx512vl";
#endif
    return all;
}

}  // namespace regain::tools
