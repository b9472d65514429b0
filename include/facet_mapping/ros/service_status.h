// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The answers of services: whatever goes wrong becomes a code and a sentence, never the end of the
// node.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

#include <facet_mapping/Status.h>

namespace facet_mapping {

/// Thrown inside a service to answer with a certain code.
class ServiceError : public std::runtime_error {
 public:
  ServiceError(std::uint8_t code, const std::string& sentence)
      : std::runtime_error(sentence), code_(code) {}
  std::uint8_t code() const { return code_; }

 private:
  std::uint8_t code_;
};

Status make_status(std::uint8_t code, const std::string& message);

/// Runs the body of a service; the string it returns is the message of an OK. ServiceError gives
/// its code, std::invalid_argument INVALID_ARGUMENT, everything else INTERNAL.
Status answer(const std::function<std::string()>& body);

}  // namespace facet_mapping
