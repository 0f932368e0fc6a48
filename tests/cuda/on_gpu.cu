// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// REGAIN_KINDS on a GPU, a kernel for each.

#include "gpu_memory.h"
#include "kinds.h"
#include "subjects.h"

namespace regain::tests {
namespace {

template <class Kind>
__global__ void answer_all(Surface surface, int variant, const Question* questions, Answer* answers,
                           int count)
{
    const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < count) answers[i] = answer_of(Kind::closure(surface, variant), questions[i]);
}

}  // namespace

std::vector<Subject> REGAIN_ON_GPU()
{
    return subjects_of(REGAIN_KINDS(), [](auto kind, int variant) -> Ask {
        using Kind = decltype(kind);
        return [variant](const Surface& surface, const std::vector<Question>& questions) {
            GpuMemory memory;
            const int count = static_cast<int>(questions.size()), block = 32;
            const Surface there = memory.copy(surface);
            const Question* asked = memory.copy(questions.data(), questions.size());
            std::vector<Answer> answers(questions.size());
            Answer* answered = memory.copy(answers.data(), answers.size());
            answer_all<Kind>
                <<<(count + block - 1) / block, block>>>(there, variant, asked, answered, count);
            memory.check(cudaGetLastError());
            memory.check(cudaMemcpy(answers.data(), answered, answers.size() * sizeof(Answer),
                                    cudaMemcpyDeviceToHost));
            return answers;
        };
    });
}

}  // namespace regain::tests
