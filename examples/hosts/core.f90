! SPDX-License-Identifier: MIT
!
! core.f90 - iqn.h on fields of Fortran: the module kit gives weights, the fields stay where they are
!
!     -(u_xx + u_yy) + 10 u^3 = f,  u = 0 on the edge of a square,  u = sin(pi x) sin(2 pi y)
!
! A field has a layer of ghosts, so its inner numbers are no flat array.  H is one sweep of
! Gauss-Seidel; f belongs to the difference equations, so their solution is known exactly.  Beside
! it iqn_step, on copies.
module fields
    use kit
    implicit none
    integer, parameter :: dp = c_double, n = 24, columns = 20, slots = columns + 2
    real(dp), parameter :: h = 1.0_dp/(n + 1), pi = 3.14159265358979323846_dp

    type field
        real(dp) :: u(0:n + 1, 0:n + 1) = 0
    end type

contains

    pure real(dp) function inner(a, b) ! of the numbers inside
        type(field), intent(in) :: a, b
        inner = sum(a%u(1:n, 1:n)*b%u(1:n, 1:n))
    end function

    type(field) function sweep(f, x) ! two Newton steps for each number, one after the other
        type(field), intent(in) :: f, x
        real(dp) :: around, u
        integer :: i, j, k
        sweep = x
        do j = 1, n
            do i = 1, n
                associate (v => sweep%u)
                    around = v(i - 1, j) + v(i + 1, j) + v(i, j - 1) + v(i, j + 1)
                    u = v(i, j)
                    do k = 1, 2
                        u = u - (4*u - around + h**2*(10*u**3 - f%u(i, j)))/(4 + 30*h**2*u**2)
                    end do
                    v(i, j) = u
                end associate
            end do
        end do
    end function

    subroutine problem(f, exact)
        type(field), intent(out) :: f, exact
        integer :: i, j
        do j = 1, n
            do i = 1, n
                exact%u(i, j) = sin(pi*i*h)*sin(2*pi*j*h)
            end do
        end do
        associate (v => exact%u)
            f%u(1:n, 1:n) = 10*v(1:n, 1:n)**3 + (4*v(1:n, 1:n) - v(0:n - 1, 1:n) - v(2:, 1:n) &
                - v(1:n, 0:n - 1) - v(1:n, 2:))/h**2
        end associate
    end subroutine

    subroutine check(status)
        integer(c_int), intent(in) :: status
        if (status >= 0) return
        print '(a)', kit_text(iqn_message(status))
        error stop 1
    end subroutine

    type(c_ptr) function make(count, mem)
        integer(kit_long), intent(in) :: count
        real(dp), allocatable, target, intent(inout) :: mem(:)
        allocate (mem(iqn_size(count, columns, 1_c_int)/8 + 1))
        call check(iqn_make(make, count, columns, 1_c_int, mem, 8*size(mem, kind=c_size_t)))
        call check(iqn_set(make, iqn_tol_relative, 1e-9_dp))
        call check(iqn_set(make, iqn_max_iterations, 400.0_dp))
        call check(iqn_set(make, iqn_omega, 1.0_dp))
    end function

    ! A step of the core: ask, form the products, take the weights, store the pair, combine.
    subroutine step(q, f, x, v, w)
        type(c_ptr), intent(in) :: q
        type(field), intent(in) :: f
        type(field), intent(inout) :: x, v(0:slots - 1), w(0:slots - 1)
        integer(c_int) :: slot(0:slots - 1), pairs, store(1), j
        real(dp) :: dot(0:iqn_dots + 2*columns - 1), weight(0:2*slots - 1)
        type(field) :: dv, dw, dx
        pairs = iqn_ask(q, slot)
        associate (now => slot(0), base => slot(1), old => slot(2:))
            w(now) = sweep(f, x)
            v(now)%u = w(now)%u - x%u
            if (base >= 0) then
                dv%u = v(now)%u - v(base)%u
                dw%u = w(now)%u - w(base)%u
                dx%u = dw%u - dv%u
            end if
            dot(iqn_dot_rr) = inner(v(now), v(now))
            dot(iqn_dot_hh) = inner(w(now), w(now))
            dot(iqn_dot_vv) = inner(dv, dv)
            dot(iqn_dot_vr) = inner(dv, v(now))
            dot(iqn_dot_ss) = inner(dx, dx)
            dot(iqn_dot_sv) = inner(dx, dv)
            do j = 1, pairs
                dot(iqn_dots + 2*j - 2) = inner(v(old(j)), v(now))
                dot(iqn_dots + 2*j - 1) = inner(v(old(j)), dv)
            end do
        end associate
        call check(iqn_weights(q, dot, weight, store))
        if (store(1) >= 0) then
            v(store(1)) = dv
            w(store(1)) = dw
        end if
        x%u = 0
        do j = 0, slots - 1
            if (abs(weight(j)) > 0) x%u = x%u + weight(j)*v(j)%u
            if (abs(weight(slots + j)) > 0) x%u = x%u + weight(slots + j)*w(j)%u
        end do
    end subroutine
end module fields

program core
    use fields
    implicit none
    type(field) :: f, exact, x, v(0:slots - 1), w(0:slots - 1)
    type(c_ptr) :: q
    real(dp), allocatable, target :: mem(:), other(:)
    real(dp) :: flat(n*n), hflat(n*n), error
    integer :: iterations, beside, plain
    call problem(f, exact)

    q = make(int(iqn_host, kit_long), mem)
    do while (iqn_converged(q) == 0)
        call step(q, f, x, v, w)
    end do
    if (iqn_converged(q) /= 1) error stop 'no answer'
    iterations = nint(iqn_get(q, iqn_iterations))
    error = maxval(abs(x%u - exact%u))

    q = make(int(n*n, kit_long), other)
    flat = 0
    x%u = 0
    do while (iqn_converged(q) == 0)
        x%u(1:n, 1:n) = reshape(flat, [n, n])
        x = sweep(f, x)
        hflat = reshape(x%u(1:n, 1:n), [n*n])
        call check(iqn_step(q, flat, hflat))
    end do
    beside = nint(iqn_get(q, iqn_iterations))

    x%u = 0
    do plain = 1, 5000
        if (maxval(abs(x%u - exact%u)) <= error) exit
        x = sweep(f, x)
    end do
    print '(a, i0)', 'iterations ', iterations, 'iterations_iqn_step ', beside, 'sweeps_alone ', plain
    print '(a, es8.1)', 'error ', error
    if (error > 1e-7_dp .or. abs(iterations - beside) > 2 .or. 3*iterations > plain) error stop 1
end program
