/// See by_threads.h.
#pragma once

#include "by_threads.h"
