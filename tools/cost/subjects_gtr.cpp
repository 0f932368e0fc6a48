// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "subject_model.h"

#include <regain/closures/gtr.h>

namespace regain::tools::cost {

const SubjectMaker gtr_subjects = maker_of<GTR>;

}  // namespace regain::tools::cost
