// SPDX-License-Identifier: Apache-2.0
// The machine that works: what of it bears on time, and nothing that tells whose it is.

#pragma once

#include <string>
#include <string_view>

namespace stiction {

// "PROCESSOR, 8 cores, 31 GiB, Linux 6.1.0 x86_64"; cores are those that the process may use. What cannot be
// told is left out; no name of the host.
std::string MachineText();

// The first processor of a text like /proc/cpuinfo; "" if it names none.
std::string ProcessorModel(std::string_view cpuinfo);

}  // namespace stiction
