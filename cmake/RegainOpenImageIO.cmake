# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# The OpenImageIO that Regain needs, said once for all that use it.

find_package(OpenImageIO 2.3 REQUIRED)
