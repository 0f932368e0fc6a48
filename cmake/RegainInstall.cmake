# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project
