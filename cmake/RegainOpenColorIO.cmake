# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The OpenColorIO that Regain needs, said once for all that use it.

find_package(OpenColorIO 2.1...<3 REQUIRED)
