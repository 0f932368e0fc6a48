// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// A shared object with nothing in it for a host.

extern "C" int regain_nothing() { return 0; }
