// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

#pragma once

#include "integral_rows.h"

REGAIN_NAMESPACE_BEGIN
namespace luts {

/// What rows_of and table_of do for tables of up to three axes.
IntegralRows lattice_rows(const Definition& definition);
Table lattice_table(const Definition& definition, const std::vector<double>& integrals);

}  // namespace luts
REGAIN_NAMESPACE_END
