// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "facet_mapping/ros/service_status.h"

#include <exception>
#include <new>

namespace facet_mapping {

Status make_status(std::uint8_t code, const std::string& message) {
  Status status;
  status.code = code;
  status.message = message;
  return status;
}

Status answer(const std::function<std::string()>& body) {
  try {
    return make_status(Status::OK, body());
  } catch (const ServiceError& e) {
    return make_status(e.code(), e.what());
  } catch (const std::invalid_argument& e) {
    return make_status(Status::INVALID_ARGUMENT, e.what());
  } catch (const std::bad_alloc&) {
    return make_status(Status::INTERNAL, "out of memory; use fewer keyframes or a smaller mesh");
  } catch (const std::exception& e) {
    return make_status(Status::INTERNAL, std::string("unexpected, please report: ") + e.what());
  }
}

}  // namespace facet_mapping
