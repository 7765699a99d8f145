#define WF_IMPLEMENTATION
#include "/tmp/wave/now.h"
