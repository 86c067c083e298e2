// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/checker_files.h"

#include <iterator>

#include "certify/certificate_reader_py.h"
#include "certify/check_certificate_py.h"
#include "certify/check_runs_in_space_py.h"
#include "certify/check_runs_py.h"

namespace stiction {

std::map<std::string, std::string> CheckerFiles() {
  const auto text = [](const auto& bytes) { return std::string(std::begin(bytes), std::end(bytes)); };
  return {{"certificate_reader.py", text(kCertificateReaderPy)},
          {"check_certificate.py", text(kCheckCertificatePy)},
          {"check_runs.py", text(kCheckRunsPy)},
          {"check_runs_in_space.py", text(kCheckRunsInSpacePy)}};
}

}  // namespace stiction
