// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// REGAIN_KINDS on the CPU: what is expected of a GPU.

#include "kinds.h"
#include "subjects.h"

namespace regain::tests {

std::vector<Subject> REGAIN_ON_CPU()
{
    return subjects_of(REGAIN_KINDS(), [](auto kind, int variant) -> Ask {
        using Kind = decltype(kind);
        return [variant](const Surface& surface, const std::vector<Question>& questions) {
            std::vector<Answer> answers;
            for (const Question& q : questions)
                answers.push_back(answer_of(Kind::closure(surface, variant), q));
            return answers;
        };
    });
}

}  // namespace regain::tests
