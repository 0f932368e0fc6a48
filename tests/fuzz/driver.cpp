// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Runs a fuzz target without a fuzzer: over a corpus, and over so many inputs that are made of it
// by changing, leaving out, doubling and joining bytes, always the same ones.
//
//     fuzz_query_line_test CORPUS_FOLDER COUNT

#include "target.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

using Input = std::vector<std::uint8_t>;

// SplitMix64 (Steele, Lea and Flood 2014).
class Random
{
public:
    std::uint64_t bits()
    {
        std::uint64_t z = _state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::size_t below(std::size_t n) { return n ? bits() % n : 0; }

private:
    std::uint64_t _state = 0;
};

std::vector<Input> read_corpus(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Input> corpus;
    for (const auto& file : files)
    {
        std::ifstream in(file, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return corpus;
}

void change(Input& input, const std::vector<Input>& corpus, Random& random)
{
    const auto place = [&] { return static_cast<std::ptrdiff_t>(random.below(input.size() + 1)); };
    const auto length = [&](std::size_t most) {
        return static_cast<std::ptrdiff_t>(1 + random.below(std::min<std::size_t>(16, most)));
    };
    switch (random.below(6))
    {
        case 0:  // a bit
            if (!input.empty()) input[random.below(input.size())] ^= 1u << random.below(8);
            break;
        case 1:  // a byte
            if (!input.empty()) input[random.below(input.size())] = random.bits() & 255;
            break;
        case 2:  // left out
            if (!input.empty())
            {
                const std::ptrdiff_t at = place(), n = length(input.size());
                const auto end = std::min<std::ptrdiff_t>(at + n, std::ptrdiff_t(input.size()));
                input.erase(input.begin() + at, input.begin() + end);
            }
            break;
        case 3:  // doubled
            if (!input.empty())
            {
                const auto at = std::ptrdiff_t(random.below(input.size()));
                const auto end = std::min<std::ptrdiff_t>(at + length(input.size()),
                                                          std::ptrdiff_t(input.size()));
                const Input piece(input.begin() + at, input.begin() + end);
                input.insert(input.begin() + place(), piece.begin(), piece.end());
            }
            break;
        case 4:  // cut short
            input.resize(random.below(input.size() + 1));
            break;
        default:  // joined with the end of another
            const Input& other = corpus[random.below(corpus.size())];
            input.resize(random.below(input.size() + 1));
            input.insert(input.end(),
                         other.begin() + std::ptrdiff_t(random.below(other.size() + 1)),
                         other.end());
    }
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 3)
    {
        std::fprintf(stderr, "usage: %s CORPUS_FOLDER COUNT\n", argv[0]);
        return 2;
    }
    const std::vector<Input> corpus = read_corpus(argv[1]);
    const unsigned long count = std::strtoul(argv[2], nullptr, 10);
    if (corpus.empty())
    {
        std::fprintf(stderr, "the corpus %s is empty\n", argv[1]);
        return 2;
    }
    for (const Input& input : corpus) LLVMFuzzerTestOneInput(input.data(), input.size());
    Random random;
    for (unsigned long i = 0; i < count; ++i)
    {
        Input input = corpus[random.below(corpus.size())];
        for (std::size_t changes = 1 + random.below(8); changes > 0; --changes)
            change(input, corpus, random);
        LLVMFuzzerTestOneInput(input.data(), input.size());
    }
    std::printf("%zu inputs of the corpus and %lu made of them\n", corpus.size(), count);
    return 0;
}
