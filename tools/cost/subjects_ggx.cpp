// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "subject_model.h"

#include <regain/closures/ggx.h>

namespace regain::tools::cost {

const SubjectMaker ggx_subjects = maker_of<GGX>;

}  // namespace regain::tools::cost
