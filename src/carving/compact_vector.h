// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// A vector of 16 bytes that grows by half: each of millions of cells holds two of them.
#pragma once

#include <cstdint>

#include <boost/container/options.hpp>
#include <boost/container/vector.hpp>

namespace facet_mapping::carving {

template <typename Value>
using CompactVector = boost::container::vector<
    Value,
    void,
    boost::container::vector_options_t<
        boost::container::stored_size<std::uint32_t>,
        boost::container::growth_factor<boost::container::growth_factor_50>>>;

}  // namespace facet_mapping::carving
