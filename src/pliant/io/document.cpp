#include "pliant/io/document.h"
