// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "subject_model.h"

#include <regain/closures/std.h>

namespace regain::tools::cost {

const SubjectMaker std_subjects = maker_of<STD>;

}  // namespace regain::tools::cost
