// SPDX-License-Identifier: Apache-2.0
// The unit that cmake/precompiled.h is compiled for.
