#include "mspskel/collapse/topology_certificate.h"

#include "mspskel/collapse/detail/topology_certificate_impl.h"
