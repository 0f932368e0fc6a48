// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#include "subject_model.h"

#include <regain/closures/beckmann.h>

namespace regain::tools::cost {

const SubjectMaker beckmann_subjects = maker_of<Beckmann>;

}  // namespace regain::tools::cost
